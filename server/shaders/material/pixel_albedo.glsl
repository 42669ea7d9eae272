// SPDX-License-Identifier: Apache-2.0
// A pixel's reflectance in 32 bits: square roots of it, and in scenes where textures give roughness or metalness
// (REFLECTANCE_TEXTURED) its place in the material's grid. Rounded up or down at random, so that means over pixels
// are right: with 8 bits to the nearest, a wall of 0.5 was 0.4 % too dark all over.
#include "random_hash.glsl"

/// Stage: 0, 1: of the two that may pack the same pixel. index: of the pixel.
uint pack_albedo(vec3 albedo, float place, uint index, uint stage) {
    vec3 root = sqrt(clamp(albedo, 0.0, 1.0));
    vec3 up = random_numbers_of(index, stage);
#ifdef REFLECTANCE_TEXTURED
    uvec3 c = uvec3(min(root * 255.0 + up, 255.0));
    return c.r | c.g << 8 | c.b << 16 | uint(place * 255.0 + 0.5) << 24;
#else
    uvec3 c = uvec3(min(root * vec3(2047.0, 2047.0, 1023.0) + up, vec3(2047.0, 2047.0, 1023.0)));
    return c.r | c.g << 11 | c.b << 22;
#endif
}

vec3 unpack_albedo(uint packed_albedo) {
#ifdef REFLECTANCE_TEXTURED
    vec3 root = unpackUnorm4x8(packed_albedo).rgb;
#else
    vec3 root = vec3(packed_albedo & 2047u, packed_albedo >> 11 & 2047u, packed_albedo >> 22) /
                vec3(2047.0, 2047.0, 1023.0);
#endif
    return root * root;
}

/// In the material's ReflectanceGrid.
float unpack_place(uint packed_albedo) {
#ifdef REFLECTANCE_TEXTURED
    return float(packed_albedo >> 24) / 255.0;
#else
    return 0.0;
#endif
}
