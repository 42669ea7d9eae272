// SPDX-License-Identifier: Apache-2.0
// Sums patch_power of what a special phase sends over blocks of patches, always in the same order.
#include "layouts.glsl"
layout(local_size_x = POWER_BLOCK) in;
#include "linear_index.glsl"
#include "power.glsl"
uniform uint patch_count;
shared vec3 sums[POWER_BLOCK];

void main() {
    uint i = linear_index();
    uint lane = gl_LocalInvocationID.x;
    sums[lane] = i < patch_count ? patch_power(i) : vec3(0.0);
    for (uint stride = POWER_BLOCK / 2; stride > 0u; stride /= 2u) {
        barrier();
        if (lane < stride) {
            sums[lane] += sums[lane + stride];
        }
    }
    if (lane == 0u && i < patch_count) {
        blocks[linear_group()].xyz = sums[0];
    }
}
