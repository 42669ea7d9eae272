// SPDX-License-Identifier: Apache-2.0
// Fluxes of the iterate, summed over blocks of patches that belong to one zone, always in the same order.
#include "layouts.glsl"
layout(local_size_x = POWER_BLOCK) in;
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_ZONE_ORDER) readonly buffer OrderBuffer { uint zone_order[]; };
layout(std430, binding = BINDING_FLUX) writeonly buffer FluxBuffer { FluxSums flux[]; };
#include "patch_exitance.glsl"
#include "patch_flux.glsl"

void main() {
    uint i = zone_order[gl_GlobalInvocationID.x];
    FluxSums sum = no_flux;
    if (i != NO_PATCH) {
        sum = patch_flux(i);
    }
    sum = sum_fluxes(sum);
    if (gl_LocalInvocationID.x == 0u) {
        flux[gl_WorkGroupID.x] = sum;
    }
}
