// SPDX-License-Identifier: Apache-2.0
// Partial sums of the scatter (scatter.glsl) over patches by area, in a fixed order: x of parallel, y of
// perspective bundles. What is measured from now on weighs twice as much.
#include "layouts.glsl"
layout(local_size_x = 256) in;
#include "scatter.glsl"
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_STATISTICS) writeonly buffer StatisticsBuffer { vec4 partial[]; };
uniform uint patch_count;
shared vec2 sums[256];

void main() {
    uint lane = gl_LocalInvocationID.x;
    vec2 sum = vec2(0.0);
    uint scouts = (patch_count + scout_stride - 1u) / scout_stride;
    for (uint i = gl_GlobalInvocationID.x; i < scouts; i += gl_NumWorkGroups.x * 256u) {
        sum += patches[i * scout_stride].area * scatter[i];
        scatter[i] *= 0.5;
    }
    sums[lane] = sum;
    for (uint half_width = 128u; half_width > 0u; half_width /= 2u) {
        barrier();
        if (lane < half_width) {
            sums[lane] += sums[lane + half_width];
        }
    }
    if (lane == 0u) {
        partial[gl_WorkGroupID.x] = vec4(sums[0], 0.0, 0.0);
    }
}
