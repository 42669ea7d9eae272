// SPDX-License-Identifier: Apache-2.0
// Partial sums behind `settled`, in a fixed order, over patches by area: x = squared size of the correction
// since the last settled state (since loading: of everything), y = its squared error that is left (checkpoint.glsl),
// both relative to the patch's light: a few patches beside a lamp hold a thousand times that of the room, and
// would decide alone.
// And the squared irradiance (z), with the squared distance of the iterate from the mean (w): how noisy
// samples are.
#include "layouts.glsl"
layout(local_size_x = 256) in;
#include "group_sum.glsl"
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_CHECKPOINT) readonly buffer CheckpointBuffer { vec4 checkpoint[]; };
layout(std430, binding = BINDING_STATISTICS) writeonly buffer StatisticsBuffer { vec4 partial[]; };
layout(std430, binding = BINDING_SOURCE) readonly buffer SourceBuffer { vec4 source[]; };
uniform uint patch_count;
uniform float relevance;         // changes below this share of the value count as noise

#include "checkpoint.glsl"

void main() {
    vec4 sum = vec4(0.0);
    uint stride = gl_NumWorkGroups.x * 256u;
    for (uint i = gl_GlobalInvocationID.x; i < patch_count; i += stride) {
        float now = luminance(irradiance[i].rgb);
        float weight = irradiance[i].w;
        float astray = luminance(source[i].rgb) - now;
        sum.z += patches[i].area * now * now;
        sum.w += patches[i].area * astray * astray;
        vec4 c = checkpoint[i];
        float correction = correction_size(c, now);
        float scale = correction_scale(c, now);
        if (weight > 0.0 && correction > relevance * scale) {
            float relative_area = patches[i].area / (scale * scale);
            sum.x += relative_area * correction * correction;
            sum.y += relative_area * correction_left(c, now, weight);
        }
    }
    vec4 total = group_sum(sum);
    if (gl_LocalInvocationID.x == 0u) {
        partial[gl_WorkGroupID.x] = total;
    }
}
