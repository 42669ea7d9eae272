// SPDX-License-Identifier: Apache-2.0
// Points of some patches on which the light of many lamps is looked for, lamp_parts of each.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "scene_geometry.glsl"
#include "mesh.glsl"
#ifndef FACETS
#include "facets.glsl"
#endif
#include "first_shot.glsl"
#include "lamps.glsl"
#include "patch_members.glsl"
#include "sides.glsl"
/// Patches in the order in which they are looked at.
layout(std430, binding = BINDING_LAMP_ORDER) readonly buffer LampOrderBuffer { uint lamp_order[]; };
uniform uint first_patch;  // of that order
uniform uint end_patch;
uniform uint parts;
uniform uvec4 moved_objects;
uniform uint shift;  // other places on patches of several triangles, or where there is one part

/// Barycentric weights of corners 1 and 2 at the centroid of the k-th of 4 equal parts.
vec2 part_centroid(uint k) {
    return k == 0u   ? vec2(1.0 / 6.0)
           : k == 1u ? vec2(2.0 / 3.0, 1.0 / 6.0)
           : k == 2u ? vec2(1.0 / 3.0)
                     : vec2(1.0 / 6.0, 2.0 / 3.0);
}

void main() {
    uint i = linear_index();
    uint at = first_patch + i / parts;
    if (at >= end_patch) {
        return;
    }
    uint part = i % parts;
    uint patch_id = lamp_order[at];
    bool whole = member_count(patch_id) == 1u;
    float share = fract((float(part) + 0.5) / float(parts) + float(shift) * 0.61803399);
    uint side = side_within(patch_id, share);
    vec2 v = part_centroid(parts == 1u ? shift & 3u : part);
    if (!whole) {  // places of an additive sequence
        vec2 u = fract(vec2(0.5) + float(part + 4u * shift) * vec2(0.75487767, 0.56984029));
        v = u.x + u.y > 1.0 ? 1.0 - u : u;
    }
    uvec3 t = triangle_of(side).xyz;
    LampPoint point;
    point.position = world_position(t.x) * (1.0 - v.x - v.y) + world_position(t.y) * v.x + world_position(t.z) * v.y;
    point.normal = whole ? patch_plane(patch_id).xyz : side_normal(side);
    point.facet = NO_HIT;
    bool moved = any(equal(moved_objects, uvec4(floatBitsToUint(patch_attributes(patch_id).z))));
    point.cell = lamp_cells[patch_id] | (moved ? LAMP_POINT_MOVED : 0u);
    lamp_points[i] = point;
}
