// SPDX-License-Identifier: Apache-2.0
// Sums over a work group in a fixed order. The group has one dimension, and a power of two invocations.
shared vec4 group_sums[gl_WorkGroupSize.x];

/// Sum of the values of all invocations, all of which call it; the first one gets it.
vec4 group_sum(vec4 value) {
    uint lane = gl_LocalInvocationID.x;
    group_sums[lane] = value;
    for (uint half_width = gl_WorkGroupSize.x / 2u; half_width > 0u; half_width /= 2u) {
        barrier();
        if (lane < half_width) {
            group_sums[lane] += group_sums[lane + half_width];
        }
    }
    return group_sums[lane];
}
