// SPDX-License-Identifier: Apache-2.0
// Selection density p_j / A_j of every patch and the running sum of p_j within its block.
#include "layouts.glsl"
layout(local_size_x = POWER_BLOCK) in;
#include "linear_index.glsl"
#include "power.glsl"
layout(std430, binding = BINDING_CDF) writeonly buffer CdfBuffer { float cdf[]; };
uniform uint patch_count;
uniform uint block_count;
shared float sums[POWER_BLOCK];

void main() {
    uint i = linear_index();
    uint lane = gl_LocalInvocationID.x;
    vec3 total = blocks[block_count].xyz;
    float p = 0.0;
    if (i < patch_count) {
        p = selection_probability(patch_power(i), total);
        radiance[i].w = p * patches[larger_place(i)].inverse_area;
    }
    sums[lane] = p;
    for (uint stride = 1u; stride < POWER_BLOCK; stride *= 2u) {
        barrier();
        float left = lane >= stride ? sums[lane - stride] : 0.0;
        barrier();
        sums[lane] += left;
    }
    if (i < patch_count) {
        cdf[i] = sums[lane];
    }
}
