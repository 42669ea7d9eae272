// SPDX-License-Identifier: Apache-2.0
// Fluxes of the iterate, summed over blocks of patches, always in the same order.
#include "layouts.glsl"
layout(local_size_x = POWER_BLOCK) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_FLUX) writeonly buffer FluxBuffer { FluxSums flux[]; };
#include "patch_exitance.glsl"
#include "patch_flux.glsl"
uniform uint patch_count;

void main() {
    uint i = linear_index();
    FluxSums sum = sum_fluxes(i < patch_count ? patch_flux(i) : no_flux);
    if (gl_LocalInvocationID.x == 0u && i < patch_count) {
        flux[linear_group()] = sum;
    }
}
