// SPDX-License-Identifier: Apache-2.0
// Puts the iterate to the level that energy conservation asks for (solution_balance.comp), and sums of patch_power over blocks of patches,
// always in the same order.
#include "layouts.glsl"
layout(local_size_x = POWER_BLOCK) in;
#include "power.glsl"
layout(std430, binding = BINDING_SOURCE) buffer SourceBuffer { vec4 source[]; };
layout(std430, binding = BINDING_BALANCE) readonly buffer BalanceBuffer { Balance balance; };
uniform uint patch_count;
shared vec3 sums[POWER_BLOCK];
void main() {
    uint i = gl_GlobalInvocationID.x;
    uint lane = gl_LocalInvocationID.x;
    sums[lane] = vec3(0.0);
    if (i < patch_count) {
        source[i].rgb *= balance.scale.rgb;
        radiance[i].rgb = surfaces[i].emission.rgb + surfaces[i].albedo.rgb * source[i].rgb / pi;
        sums[lane] = patch_power(i);
    }
    for (uint stride = POWER_BLOCK / 2; stride > 0u; stride /= 2u) {
        barrier();
        if (lane < stride) {
            sums[lane] += sums[lane + stride];
        }
    }
    if (lane == 0u) {
        blocks[gl_WorkGroupID.x].xyz = sums[0];
    }
}
