// SPDX-License-Identifier: Apache-2.0
// Nearest surface: 2 * facet + side (0 front, 1 back), of a hemicube or, with PARALLEL, a window. STAGGERED:
// of some of the pixels.
#include "layouts.glsl"
#include "density.glsl"
#include "hemicube.glsl"
#ifdef ALPHA_MASK
layout(location = 0) in vec2 mesh_uv;
#include "alpha_mask.glsl"
#endif
#if defined(GLASS) && !defined(SHOW_GLASS)
#define GLASS_PASSES
uniform uint facet_base;
vec3 line_direction() {
#ifdef PARALLEL
    return bundle.axis_z.xyz;
#else
    int face;
    vec3 d = hemicube_direction(sample_point(ivec2(gl_FragCoord.xy)), float(bundle.resolution.x), face);
    return mat3(bundle.axis_x.xyz, bundle.axis_y.xyz, bundle.axis_z.xyz) * normalize(d);
#endif
}
#include "glass.glsl"
#endif
#if !defined(ALPHA_MASK) && !defined(GLASS_PASSES) && !defined(STAGGERED)
layout(early_fragment_tests) in;
#endif
#ifdef STAGGERED  // only pixels whose column and row leave these remainders, see view_place.glsl
uniform uint remainder_x, remainder_y;
#endif
layout(location = 0) out uint surface;

uniform uint first_facet;

void main() {
    uint facet = first_facet + uint(gl_PrimitiveID);
#ifdef STAGGERED
    if (uvec2(gl_FragCoord.xy) % STAGGER_PERIOD != uvec2(remainder_x, remainder_y)) {
        discard;
    }
#endif
#ifdef ALPHA_MASK
    if (!covered(facet, mesh_uv)) {
        discard;
    }
#endif
#ifdef GLASS_PASSES
    if (passes(facet, line_direction(), uint(gl_FragCoord.y) << 16 | uint(gl_FragCoord.x))) {
        discard;
    }
#endif
    surface = facet * 2u + (gl_FrontFacing ? 0u : 1u);
}
