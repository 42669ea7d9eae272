// SPDX-License-Identifier: Apache-2.0
// End of a stage of a special phase: the mean of its K bundles joins the increments, with the variance
// of that mean as the bundles show it.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "luminance.glsl"
layout(std430, binding = BINDING_INCREMENTS) buffer IncrementBuffer { vec4 increments[]; };
layout(std430, binding = BINDING_STAGE) buffer StageBuffer { vec4 stage[]; };
uniform uint patch_count;
uniform float bundles;  // K
uniform float unseen;   // share of the mean that may be missing: its square joins the variance

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    vec4 sum = stage[i];
    if (sum == vec4(0.0)) {
        return;
    }
    vec3 mean = sum.rgb / bundles;
    float l = luminance(abs(mean));
    // One bundle alone says nothing about its own variance: taken to be as large as its square.
    float variance = bundles > 1.0 ? max(sum.w / bundles - l * l, 0.0) / (bundles - 1.0) : l * l;
    // Bundles that all agree may all have missed the same: never less than a small share.
    variance = max(variance, 0.01 * l * l / bundles) + unseen * unseen * l * l;
    increments[i] += vec4(mean, variance);
    stage[i] = vec4(0.0);
}
