// SPDX-License-Identifier: Apache-2.0
// Nearest surface: 2 * facet + side (0 front, 1 back).
#include "layouts.glsl"
#ifdef ALPHA_MASK
#include "alpha_mask.glsl"
#endif
#if defined(GLASS) && !defined(SHOW_GLASS)
#define GLASS_PASSES
#include "glass.glsl"
#endif
#if !defined(ALPHA_MASK) && !defined(GLASS_PASSES)
layout(early_fragment_tests) in;
#endif
layout(location = 0) out uint surface;

uniform uint first_facet;

void main() {
    uint facet = first_facet + uint(gl_PrimitiveID);
#ifdef ALPHA_MASK
    if (!covered(facet)) {
        discard;
    }
#endif
#ifdef GLASS_PASSES
    if (is_glass(facet)) {
        discard;
    }
#endif
    surface = facet * 2u + (gl_FrontFacing ? 0u : 1u);
}
