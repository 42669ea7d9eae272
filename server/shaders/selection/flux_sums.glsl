// SPDX-License-Identifier: Apache-2.0
// Sums fluxes over a work group of POWER_BLOCK invocations in a fixed order; the first one gets the sum.
shared FluxSums fluxes[POWER_BLOCK];

FluxSums sum_fluxes(FluxSums own) {
    uint lane = gl_LocalInvocationID.x;
    fluxes[lane] = own;
    for (uint stride = POWER_BLOCK / 2; stride > 0u; stride /= 2u) {
        barrier();
        if (lane < stride) {
            fluxes[lane].incident += fluxes[lane + stride].incident;
            fluxes[lane].reflected += fluxes[lane + stride].reflected;
            fluxes[lane].emitted += fluxes[lane + stride].emitted;
        }
    }
    return fluxes[lane];
}

const FluxSums no_flux = FluxSums(vec4(0.0), vec4(0.0), vec4(0.0));
