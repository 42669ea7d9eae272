// SPDX-License-Identifier: Apache-2.0
// Partial sums of the scatter (scatter.glsl) over patches by area, in a fixed order: x of parallel, y of
// perspective bundles. What is measured from now on weighs twice as much.
#include "layouts.glsl"
layout(local_size_x = 256) in;
#include "group_sum.glsl"
#include "scatter.glsl"
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_STATISTICS) writeonly buffer StatisticsBuffer { vec4 partial[]; };
uniform uint patch_count;

void main() {
    vec2 sum = vec2(0.0);
    uint scouts = (patch_count + scout_stride - 1u) / scout_stride;
    for (uint i = gl_GlobalInvocationID.x; i < scouts; i += gl_NumWorkGroups.x * 256u) {
        sum += patches[i * scout_stride].area * scatter[i];
        scatter[i] *= 0.5;
    }
    vec4 total = group_sum(vec4(sum, 0.0, 0.0));
    if (gl_LocalInvocationID.x == 0u) {
        partial[gl_WorkGroupID.x] = total;
    }
}
