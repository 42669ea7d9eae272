// SPDX-License-Identifier: Apache-2.0
// Radiance of all patches along a parallel bundle. Every patch has just one direction in which it can send:
// that end of the bundle's axis which is above it. A random point stands for the patch.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "density.glsl"
#include "scene_geometry.glsl"
#include "sending_gloss.glsl"
#include "random_hash.glsl"
#include "patch_members.glsl"
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;
layout(std430, binding = BINDING_SENT) writeonly buffer SentBuffer { vec4 sent[]; };
uniform uint patch_count;
uniform uint patch_base;  // patches and vertices of the place that is drawn
uniform uint vertex_base;

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    vec4 texel = texelFetch(radiance_texels, int(i));
    RARELY(is_glossy(i)) {
        vec3 normal = patch_plane(patch_base + i).xyz;
        vec3 axis = bundle.axis_z.xyz;
        vec3 w_out = dot(axis, normal) < 0.0 ? -axis : axis;
        // The bundle's direction is as good a number as any to tell iterations apart.
        vec2 u = random_numbers_of(i, floatBitsToUint(axis.x) ^ floatBitsToUint(axis.y) << 1).xy;
        float share = u.x;
        uvec3 t = load_triangle(triangle_of_side(side_within(i, share))).xyz + vertex_base;
        float root = sqrt(share);
        vec3 point = world_position(t.x) * (1.0 - root) + world_position(t.y) * (root * (1.0 - u.y)) +
                     world_position(t.z) * (root * u.y);
        vec3 middle = centroid_of(triangle_of_patch(i), vertex_base);
        texel.rgb += difference_radiance(sending_gloss(i, normal, middle, point), normal, w_out);
    }
    sent[i] = texel;
}
