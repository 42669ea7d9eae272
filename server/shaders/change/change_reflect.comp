// SPDX-License-Identifier: Apache-2.0
// What patches send of the increments received so far, T_new dL of ch. 7.4: their own light a dL_in / pi.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_INCREMENTS) readonly buffer IncrementBuffer { vec4 increments[]; };
layout(std430, binding = BINDING_STAGE) readonly buffer StageBuffer { vec4 stage[]; };
layout(std430, binding = BINDING_CHANGED_RADIANCE) writeonly buffer ChangedBuffer { vec4 changed[]; };
uniform uint patch_count;
uniform float stage_share;  // of the running stage's sums, 1/(bundles so far)

void main() {
    uint i = linear_index();
    if (i < patch_count) {
        vec3 incident = increments[i].rgb + stage_share * stage[i].rgb;
        changed[i] = vec4(surfaces[i].albedo.rgb * incident * 0.31830988618, 0.0);
    }
}
