// SPDX-License-Identifier: Apache-2.0
// The points of some pixels on which the light of many lamps is looked for.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "scene_geometry.glsl"
#include "mesh.glsl"
#include "sides.glsl"
#ifndef FACETS
#include "facets.glsl"
#endif
#include "rarely.glsl"
#include "first_shot.glsl"
#include "lamps.glsl"
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
uniform uint first_pixel;
uniform uint end_pixel;

void main() {
    uint i = linear_index();
    uint index = first_pixel + i;
    if (index >= end_pixel) {
        return;
    }
    uvec4 p = texelFetch(pixel_texels, int(2u * index));       // position, side
    uvec4 q = texelFetch(pixel_texels, int(2u * index + 1u));  // normal, albedo, barycentric, facet
    LampPoint point = LampPoint(vec3(0.0), NO_HIT, vec3(0.0), 0xffffffffu);
    if (p.w != NO_PATCH) {
        // The surface point itself: the stored one is kept away from creases.
        uvec3 t = triangle_of(p.w).xyz;
        vec2 v = unpackUnorm2x16(q.z);
        point.position = world_position(t.x) * (1.0 - v.x - v.y) + world_position(t.y) * v.x + world_position(t.z) * v.y;
        point.normal = side_normal(p.w);
        point.facet = q.w & PIXEL_FACET_MASK;
        point.cell = lamp_cells[patch_of_side(p.w)];
    }
    lamp_points[i] = point;
}
