// SPDX-License-Identifier: Apache-2.0
// Marks the texels of a shadow map near which a surface begins or ends. CUT_OUT: all texels of surfaces that alpha cuts.
#include "layouts.glsl"
#ifdef CUT_OUT
layout(binding = UNIT_FACETS) uniform samplerBuffer facet_texels;
layout(binding = UNIT_MATERIALS) uniform samplerBuffer material_texels;
uniform uint first_facet;
#endif
layout(location = 0) out uint marked;

void main() {
#ifdef CUT_OUT
    int facet = int(first_facet + uint(gl_PrimitiveID));
    int material = 5 * int(floatBitsToUint(texelFetch(facet_texels, 4 * facet + 3).w));
    if (texelFetch(material_texels, material).w <= 0.0) {
        discard;
    }
#endif
    marked = 1u;
}
