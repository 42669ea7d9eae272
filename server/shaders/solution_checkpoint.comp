// SPDX-License-Identifier: Apache-2.0
// Remembers the state before a change: x = luminance of the mean irradiance, y = its weight. The phase then
// sets z = variance of its increment over the square of that, 0: nothing has come in, and w = two halves: the error
// that is left, relative to the mean, and the weight that it keeps (solution_correct.comp).
#include "layouts.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_CHECKPOINT) writeonly buffer CheckpointBuffer { vec4 checkpoint[]; };
uniform uint patch_count;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < patch_count) {
        float before = dot(irradiance[i].rgb, vec3(0.2126, 0.7152, 0.0722));
        checkpoint[i] = vec4(before, irradiance[i].w, 0.0, 0.0);
    }
}
