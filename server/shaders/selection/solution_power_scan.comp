// SPDX-License-Identifier: Apache-2.0
// Totals of all blocks and the probability of all blocks before each one. A single work group.
#include "layouts.glsl"
layout(local_size_x = POWER_BLOCK) in;
#include "power.glsl"
uniform uint block_count;
shared vec3 sums[POWER_BLOCK];

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint chunk = (block_count + POWER_BLOCK - 1u) / POWER_BLOCK;
    uint begin = min(lane * chunk, block_count);
    uint end = min(begin + chunk, block_count);
    vec3 sum = vec3(0.0);
    for (uint b = begin; b < end; ++b) {
        sum += blocks[b].xyz;
    }
    sums[lane] = sum;
    barrier();
    vec3 prefix = vec3(0.0);
    vec3 total = vec3(0.0);
    for (uint other = 0u; other < POWER_BLOCK; ++other) {
        prefix = other == lane ? total : prefix;
        total += sums[other];
    }
    for (uint b = begin; b < end; ++b) {
        blocks[b].w = selection_probability(prefix, total);
        prefix += blocks[b].xyz;
    }
    if (lane == 0u) {
        blocks[block_count] = vec4(total, 1.0);
    }
}
