// SPDX-License-Identifier: Apache-2.0

/// Three independent numbers in [0, 1) of a patch and an iteration (pcg3d of Jarzynski and Olano 2020, "Hash
/// Functions for GPU Rendering").
vec3 random_numbers_of(uint patch_id, uint iteration) {
    uvec3 v = uvec3(patch_id, iteration, 0x9e3779b9u) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3(v >> 8u) * (1.0 / 16777216.0);
}
