// SPDX-License-Identifier: Apache-2.0
// Remembers the state before a change. Where the last one is not settled (`unsettled`), the two are one: the
// state before that stays, and the error that it has left is the first part of what this one leaves.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_CHECKPOINT) buffer CheckpointBuffer { vec4 checkpoint[]; };
#include "checkpoint.glsl"
uniform uint patch_count;
uniform bool unsettled;

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    float now = luminance(irradiance[i].rgb);
    float weight = irradiance[i].w;
    vec4 c = checkpoint[i];
    if (!unsettled || weight <= 0.0) {
        checkpoint[i] = vec4(now, pack_pair(vec2(weight, 0.0)), 0.0, 0.0);
        return;
    }
    vec2 before = vec2(unpack_pair(c.y).x, correction_size(c, now));
    vec4 next = vec4(c.x, pack_pair(before), 0.0, 0.0);
    next.w = pack_left(sqrt(correction_left(c, now, weight)) / correction_scale(next, now), weight);
    checkpoint[i] = next;
}
