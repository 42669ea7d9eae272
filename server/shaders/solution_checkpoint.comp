// SPDX-License-Identifier: Apache-2.0
// Remembers the state before a change: luminance and weight of the mean irradiance.
#include "layouts.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_CHECKPOINT) writeonly buffer CheckpointBuffer { vec2 checkpoint[]; };
uniform uint patch_count;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < patch_count) {
        checkpoint[i] = vec2(dot(irradiance[i].rgb, vec3(0.2126, 0.7152, 0.0722)), irradiance[i].w);
    }
}
