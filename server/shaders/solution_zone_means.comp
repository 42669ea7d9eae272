// SPDX-License-Identifier: Apache-2.0
// Light by the mean that was kept over the last change (incident), by the one since (reflected), and the weight of the
// latter (emitted), summed over blocks
// of patches that belong to one zone, always in the same order.
#include "layouts.glsl"
layout(local_size_x = POWER_BLOCK) in;
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_ZONE_ORDER) readonly buffer OrderBuffer { uint zone_order[]; };
layout(std430, binding = BINDING_KEPT) readonly buffer KeptBuffer { vec4 kept[]; };
layout(std430, binding = BINDING_SINCE) readonly buffer SinceBuffer { vec4 since[]; };
layout(std430, binding = BINDING_FLUX) writeonly buffer FluxBuffer { FluxSums flux[]; };
#include "flux_sums.glsl"

void main() {
    uint i = zone_order[gl_GlobalInvocationID.x];
    FluxSums sum = no_flux;
    if (i != NO_PATCH) {
        float area = patches[i].area;
        sum = FluxSums(area * vec4(kept[i].rgb, 0.0), area * vec4(since[i].rgb, 0.0), area * vec4(since[i].w, 0.0, 0.0, 1.0));
    }
    sum = sum_fluxes(sum);
    if (gl_LocalInvocationID.x == 0u) {
        flux[gl_WorkGroupID.x] = sum;
    }
}
