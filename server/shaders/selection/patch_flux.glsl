// SPDX-License-Identifier: Apache-2.0
#include "flux_sums.glsl"

/// Fluxes of a patch by its iterate.
FluxSums patch_flux(uint i) {
    float area = patches[i].area;
    return FluxSums(area * vec4(source[i].rgb, 0.0), area * vec4(reflected_exitance(i), 0.0),
                    area * vec4(emitted_exitance(i), 1.0));
}
