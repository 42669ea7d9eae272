// SPDX-License-Identifier: Apache-2.0
// Sums the blocks of each zone: one work group a zone.
#include "layouts.glsl"
layout(local_size_x = POWER_BLOCK) in;
layout(std430, binding = BINDING_FLUX) readonly buffer FluxBuffer { FluxSums flux[]; };
layout(std430, binding = BINDING_ZONE_ORDER) readonly buffer FirstBlockBuffer { uint first_block[]; };
layout(std430, binding = BINDING_ZONE_SUMS) writeonly buffer SumBuffer { vec4 sums[]; };
#include "flux_sums.glsl"
uniform uint first_sum;

void main() {
    uint zone = gl_WorkGroupID.x;
    FluxSums sum = no_flux;
    for (uint b = first_block[zone] + gl_LocalInvocationID.x; b < first_block[zone + 1u]; b += POWER_BLOCK) {
        sum.incident += flux[b].incident;
        sum.reflected += flux[b].reflected;
        sum.emitted += flux[b].emitted;
    }
    sum = sum_fluxes(sum);
    if (gl_LocalInvocationID.x == 0u) {
        uint at = first_sum + 3u * zone;
        sums[at] = sum.incident;
        sums[at + 1u] = sum.reflected;
        sums[at + 2u] = sum.emitted;
    }
}
