// SPDX-License-Identifier: Apache-2.0
// Chooses shooting points: patch by selection probability, point uniformly on it (ch. 5.1).
#include "layouts.glsl"
layout(local_size_x = 16) in;
#include "power.glsl"
layout(std430, binding = BINDING_CDF) readonly buffer CdfBuffer { float cdf[]; };
layout(std430, binding = BINDING_WORLD_POSITIONS) readonly buffer WorldBuffer { vec4 world[]; };
layout(std430, binding = BINDING_TRIANGLES) readonly buffer TriangleBuffer { uvec4 triangles[]; };
layout(std430, binding = BINDING_SHOOTERS) writeonly buffer ShooterBuffer { Shooter shooters[]; };
#ifdef GLOSSY
#include "gloss.glsl"
#endif
#ifdef PATCH_SETS
layout(binding = UNIT_SIDES) uniform usamplerBuffer side_texels;  // patch, triangle
#endif
#include "patch_members.glsl"
uniform uint patch_count;
uniform uint block_count;
uniform uint shooter_count;
uniform float diameter;  // of the scene, m
/// Per shooter: x, y = leading and trailing 24 bits of the number that chooses the patch; z, w = point.
uniform vec4 random_numbers[16];

#ifdef GLOSSY
/// Mirror direction of the light that a glossy patch has accepted, and the share that the glossy part has in
/// what it sends there.
vec4 main_lobe(uint id, vec3 normal, vec3 point) {
    uvec4 packed_gloss = texelFetch(gloss_texels, int(id));
    vec3 w_in = direction_to(gloss_source(packed_gloss), centroid_of(triangles[patches[id].triangle].xyz, 0u), point);
    Gloss g;
    g.scale = gloss_scale(packed_gloss);
    g.w_in = w_in;
    g.brdf = patch_brdf(id);
    g.at_in = brdf_at(g.brdf, dot(normal, w_in));
    vec3 mirrored = 2.0 * dot(normal, w_in) * normal - w_in;
    float peak = luminance(abs(difference_radiance(g, normal, mirrored)));
    float main_part = max(luminance(radiance[id].rgb), 1e-20);
    return vec4(mirrored, peak / (peak + main_part));
}
#endif

uint find_block(float u) {
    uint low = 0u;
    uint high = block_count - 1u;
    while (low < high) {
        uint middle = (low + high + 1u) / 2u;
        if (blocks[middle].w <= u) {
            low = middle;
        } else {
            high = middle - 1u;
        }
    }
    return low;
}

uint find_patch(uint first, uint last, float u) {
    while (first < last) {
        uint middle = (first + last) / 2u;
        if (cdf[middle] > u) {
            last = middle;
        } else {
            first = middle + 1u;
        }
    }
    return first;
}

/// Barycentric weights of a point that is uniform on a triangle.
vec3 uniform_weights(vec2 u) {
    float root = sqrt(u.x);
    return vec3(1.0 - root, root * (1.0 - u.y), root * u.y);
}

/// Number of a side's triangle.
uint triangle_of_side(uint side) {
#ifdef PATCH_SETS
    return texelFetch(side_texels, int(side)).y;
#else
    return patches[side].triangle;
#endif
}

/// Of a side, unit, at a place; index: of its patch there.
vec3 facing(uint side, uvec3 v, uint index) {
#ifdef PATCH_SETS
    vec3 n = cross(world[v.y].xyz - world[v.x].xyz, world[v.z].xyz - world[v.x].xyz);
    float size = length(n);
    return size > 0.0 ? (side == triangle_of_side(side) ? n : -n) / size : vec3(0.0);
#else
    return patches[index].normal;
#endif
}

vec3 point_on(uvec3 v, vec3 weights) {
    return world[v.x].xyz * weights.x + world[v.y].xyz * weights.y + world[v.z].xyz * weights.z;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= shooter_count) {
        return;
    }
    vec4 u = random_numbers[i];
    uint block = find_block(u.x);
    uint first = block * POWER_BLOCK;
    uint last = min(first + POWER_BLOCK, patch_count) - 1u;
    // Within the block the trailing bits keep the choice fine-grained however small its share is.
    float rest = min((u.x - blocks[block].w) + u.y * 5.9604645e-8, cdf[last] * 0.9999999);
    uint id = find_patch(first, last, rest);
    while (patches[larger_place(id)].area <= 0.0 && id < last) {
        ++id;
    }
    float share = u.z;
    uint side = side_within(id, share);
    uvec3 v = triangles[triangle_of_side(side)].xyz;
    uvec3 v_before = v + uint(world.length()) / 2u;
    uint larger = larger_place(id);
    uint before = uint(patches.length()) / 2u + id;
    vec3 weights = uniform_weights(vec2(share, u.w));
    vec3 position = point_on(v, weights);
    Shooter s;
    // Beyond the rounding of positions: a shooter that came out below its own plane, or its neighbours', would
    // not see what lies near the horizon.
    float lift = SHOOTER_LIFT * diameter;
    s.normal = facing(side, v, id);
    s.position = position + lift * s.normal;
    s.patch_id = id;
    s.density = density_at(id, larger, radiance[id].w);
    s.normal_before = facing(side, v_before, before);
    s.position_before = point_on(v_before, weights) + lift * s.normal_before;
    s.density_before = density_at(before, larger, radiance[id].w);
    s.pad0 = 0u;
    s.weights = vec4(weights, 0.0);
    s.object = patches[id].object;
#ifdef GLOSSY
    s.glossy = is_glossy(id) ? 1u : 0u;
    s.lobe = s.glossy != 0u ? main_lobe(id, patches[id].normal, position) : vec4(0.0);
#else
    s.glossy = 0u;
    s.lobe = vec4(0.0);
#endif
    s.probability = radiance[id].w * patches[larger].area;
    s.emitter = luminance(patch_source(id)) > 0.0 ? 1u : 0u;
    s.constant_radiance = balance.constant;
    shooters[i] = s;
}
