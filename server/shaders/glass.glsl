// SPDX-License-Identifier: Apache-2.0
// Glass (scene/specular_surface.h) lets bundles straight through, per fragment; only pictures show it (SHOW_GLASS).
// Only compiled where a scene has any (GLASS).
#ifndef ALPHA_MASK
layout(binding = UNIT_FACETS) uniform samplerBuffer facet_texels;
layout(binding = UNIT_MATERIALS) uniform samplerBuffer material_texels;
#endif

bool is_glass(uint facet) {
    int material = 5 * int(floatBitsToUint(texelFetch(facet_texels, int(4u * facet + 3u)).w));
    return texelFetch(material_texels, material + 1).w > 0.0;
}
