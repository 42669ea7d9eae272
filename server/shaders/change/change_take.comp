// SPDX-License-Identifier: Apache-2.0
// End of one bundle of a special phase: its sums join those of the stage.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "luminance.glsl"
#include "accumulator.glsl"
layout(std430, binding = BINDING_STAGE) buffer StageBuffer { vec4 stage[]; };
uniform uint patch_count;
uniform float factor;  // undoes the weight that the bundle was transferred with

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    vec3 c = factor * vec3(take_accumulated(i, 0u), take_accumulated(i, 1u), take_accumulated(i, 2u));
    if (c != vec3(0.0)) {
        float l = luminance(abs(c));
        stage[i] += vec4(c, l * l);
    }
}
