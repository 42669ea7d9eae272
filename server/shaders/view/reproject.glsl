// SPDX-License-Identifier: Apache-2.0
// Where a surface point of the new picture was in the one before (by world position and patch).
layout(binding = UNIT_OLD_PIXELS) uniform usamplerBuffer old_pixel_texels;
layout(binding = UNIT_OLD_PIXEL_IRRADIANCE) uniform samplerBuffer old_irradiance_texels;
uniform mat4 old_clip_from_world;
uniform uint old_width;
uniform uint old_height;
uniform float old_common_weight;
#ifdef CONSTANT_RADIANCE
uniform vec3 old_constant;  // ViewParameters::constant of that picture
#endif
uniform uvec4 moved_objects;  // whose place 1 differs, the rest NO_PATCH
uniform float kept_weight;    // share of the old weight that a reprojected value keeps
uniform float same_distance;  // m, at unit distance, seen head-on: points closer than this (and coplanar) are the same
uniform vec3 old_eye;

const uint hidden = 0xffffffffu;

/// Pixel that showed this surface point in the picture before, or `hidden`.
uint old_pixel(vec3 old_position, vec3 normal, uint id, uint object) {
    vec4 clip = old_clip_from_world * vec4(old_position, 1.0);
    if (clip.w <= 0.0) {
        return hidden;
    }
    ivec2 at = ivec2(floor((clip.xy / clip.w * 0.5 + 0.5) * vec2(old_width, old_height)));
    if (at.x < 0 || at.y < 0 || at.x >= int(old_width) || at.y >= int(old_height)) {
        return hidden;
    }
    uint index = uint(at.y) * old_width + uint(at.x);
    uvec4 old = texelFetch(old_pixel_texels, int(2u * index));
    bool same = old.w == id;
    if (!same && old.w != NO_PATCH &&
        facet_object(texelFetch(old_pixel_texels, int(2u * index + 1u)).w & PIXEL_FACET_MASK) == object) {
        vec3 offset = uintBitsToFloat(old.xyz) - old_position;
        float distance = same_distance * clip.w;
        // A pixel is that much longer on a surface that is seen at a slant.
        float cosine = max(abs(dot(normalize(old_eye - old_position), normal)), 0.05);
        same = length(offset) * cosine < distance && abs(dot(offset, normal)) < 0.1 * distance;
    }
    return same ? index : hidden;
}

/// A pixel's sum as it goes on in the new picture, with the share of its weight that it keeps.
vec4 carried(vec4 sum, float share) { return share * vec4(sum.rgb, pixel_weight(sum, old_common_weight)); }

#ifdef MOVED
uniform uint vertex_count;

/// Where a point of an object was before the change.
vec3 position_before(vec3 position, uint object, uvec3 triangle, vec3 weights) {
    if (!any(equal(uvec4(object), moved_objects))) {
        return position;
    }
    uvec3 before = triangle + vertex_count;
    return world_position(before.x) * weights.x + world_position(before.y) * weights.y +
           world_position(before.z) * weights.z;
}
#else
vec3 position_before(vec3 position, uint object, uvec3 triangle, vec3 weights) { return position; }
#endif
