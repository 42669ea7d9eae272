// SPDX-License-Identifier: Apache-2.0
// Nearest surface on one side of the plane of a parallel bundle, where walls may be thin: 2 * facet + side.
// Depths come from the planes of the facets, since the rasteriser snaps vertices to fractions of a pixel,
// which at a grazing angle shifts a depth by more than a thin wall's thickness. One depth decides both on
// which side of the plane a surface lies and how near it is, so that of a wall that the bundle's plane
// cuts no side is missing from both pictures.
#include "layouts.glsl"
#include "density.glsl"
#include "parallel.glsl"
#ifdef ALPHA_MASK
layout(location = 0) in vec2 mesh_uv;
#include "alpha_mask.glsl"
#elif !defined(GLASS)
layout(binding = UNIT_FACETS) uniform samplerBuffer facet_texels;
#endif
uniform uint facet_base;
#ifdef GLASS
#include "glass.glsl"
#endif
layout(location = 0) out uint surface;
uniform uint first_facet;
uniform bool ahead;  // of the plane; its picture lies above the other one

/// Depth that orders the surfaces of a line. Of two that coincide back to back the one that faces the
/// window's origin comes first, so that a wall without thickness is a wall and not a gap (figure 4.4).
float ordering_depth(vec4 plane, uint id, vec3 point) {
    float along = abs(dot(plane.xyz, bundle.axis_z.xyz));
    float shift = min(0.5 * bundle.sky.w / max(along, 1e-7), 8.0 * bundle.weights.z);
    return plane_depth(plane, point) + (faces_far(id) ? shift : -shift);
}

void main() {
    uint facet = first_facet + uint(gl_PrimitiveID);
#ifdef ALPHA_MASK
    if (!covered(facet, mesh_uv)) {
        discard;
    }
#endif
#ifdef GLASS
    if (passes(facet, bundle.axis_z.xyz, uint(gl_FragCoord.y) << 16 | uint(gl_FragCoord.x))) {
        discard;
    }
#endif
    surface = facet * 2u + (gl_FrontFacing ? 0u : 1u);
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    pixel.y -= ahead ? bundle.resolution.y : 0u;
    vec4 plane = texelFetch(facet_texels, int(4u * (facet + facet_base)));
    if (folded_over(surface, plane)) {
        discard;
    }
    float from_plane = ordering_depth(plane, surface, window_point(pixel)) - bundle.axis_x.w;
    if (ahead != (from_plane >= 0.0)) {
        discard;
    }
    gl_FragDepth = clamp(1.0 - abs(from_plane) / bundle.axis_y.w, 1e-6, 1.0);
}
