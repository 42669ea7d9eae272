// SPDX-License-Identifier: Apache-2.0
// Partial sums over patches, in a fixed order: x = flux that they reflect of the increments of a special phase
// (luminance, of either sign alike, as far as the increments can be trusted), y = that they reflect of all light.
#include "layouts.glsl"
layout(local_size_x = 256) in;
#include "group_sum.glsl"
#include "luminance.glsl"
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_INCREMENTS) readonly buffer IncrementBuffer { vec4 increments[]; };
layout(std430, binding = BINDING_STATISTICS) writeonly buffer StatisticsBuffer { vec4 partial[]; };
uniform uint patch_count;

void main() {
    vec2 sum = vec2(0.0);
    uint stride = gl_NumWorkGroups.x * 256u;
    for (uint i = gl_GlobalInvocationID.x; i < patch_count; i += stride) {
        vec3 reflecting = patches[i].area * surfaces[i].albedo.rgb;
        vec3 increment = increments[i].rgb;
        float size = luminance(abs(increment));
        float trusted = clamp(1.0 - increments[i].w / max(size * size, 1e-30), 0.0, 1.0);
        sum += vec2(trusted * luminance(reflecting * abs(increment)),
                    luminance(reflecting * max(irradiance[i].rgb + trusted * increment, 0.0)));
    }
    vec4 total = group_sum(vec4(sum, 0.0, 0.0));
    if (gl_LocalInvocationID.x == 0u) {
        partial[gl_WorkGroupID.x] = total;
    }
}
