// SPDX-License-Identifier: Apache-2.0
// Light by the mean that was kept over the last change (incident), by the one since (reflected), and (emitted) the weight
// of the latter, the patches where both have any, and what their squared differences are of themselves and
// DIFFERENCE_UNIT: few large ones weigh little. Summed over blocks of patches that belong to one zone, always in the same order.
#include "layouts.glsl"
layout(local_size_x = POWER_BLOCK) in;
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_ZONE_ORDER) readonly buffer OrderBuffer { uint zone_order[]; };
layout(std430, binding = BINDING_KEPT) readonly buffer KeptBuffer { vec4 kept[]; };
layout(std430, binding = BINDING_SINCE) readonly buffer SinceBuffer { vec4 since[]; };
layout(std430, binding = BINDING_ZONE_RAYS) writeonly buffer FluxBuffer { FluxSums flux[]; };
#include "flux_sums.glsl"
#include "zone_level.glsl"

void main() {
    uint i = zone_order[gl_GlobalInvocationID.x];
    FluxSums sum = no_flux;
    if (i != NO_PATCH) {
        float area = patches[i].area;
        vec2 q = squared_difference(zone_levels[zones[i]].kept.rgb * kept[i].rgb, kept[i].w, since[i].rgb, since[i].w);
        vec2 judged = q.x * vec2(1.0, q.y / (q.y + DIFFERENCE_UNIT));
        sum = FluxSums(area * vec4(kept[i].rgb, 0.0), area * vec4(since[i].rgb, 0.0),
                       area * vec4(since[i].w, judged, 1.0));
    }
    sum = sum_fluxes(sum);
    if (gl_LocalInvocationID.x == 0u) {
        flux[gl_WorkGroupID.x] = sum;
    }
}
