// SPDX-License-Identifier: Apache-2.0
// Partial sums over patches by area, in a fixed order: x = squared increments of the running stage of K
// bundles, y = their variance, z = squared irradiance that they come to (luminance).
#include "layouts.glsl"
layout(local_size_x = 256) in;
#include "group_sum.glsl"
#include "luminance.glsl"
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_STAGE) readonly buffer StageBuffer { vec4 stage[]; };
layout(std430, binding = BINDING_STATISTICS) writeonly buffer StatisticsBuffer { vec4 partial[]; };
uniform uint patch_count;
uniform float bundles;  // K

void main() {
    vec4 sum = vec4(0.0);
    uint stride = gl_NumWorkGroups.x * 256u;
    for (uint i = gl_GlobalInvocationID.x; i < patch_count; i += stride) {
        vec3 mean = stage[i].rgb / bundles;
        float l = luminance(abs(mean));
        float now = luminance(max(irradiance[i].rgb + mean, 0.0));
        float variance = max(stage[i].w / bundles - l * l, 0.0) / max(bundles - 1.0, 1.0);
        sum += patches[i].area * vec4(l * l, variance, now * now, 0.0);
    }
    vec4 total = group_sum(sum);
    if (gl_LocalInvocationID.x == 0u) {
        partial[gl_WorkGroupID.x] = total;
    }
}
