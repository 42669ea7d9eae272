// SPDX-License-Identifier: Apache-2.0
// The balance heuristic adapted to iteration (ch. 6.2, 6.3): whichever strategy found the pair (x, y),
// its contribution is divided by the one density d.

#ifdef MEDIUM
#include "air.glsl"
#endif
layout(std140, binding = BINDING_BUNDLE) uniform BundleBlock { BundleParameters bundle; };

/// cos_y / d(omega) at x, in sr: times L(y -> x) and the measure cos_x domega it gives irradiance.
/// d(omega) = P1/(2 pi) + P2 r/(2 pi R) + P3 (p_j/A_j) r^2/cos_y + beside, ch. 6.3; the form below stays
/// finite for cos_y -> 0 and r -> 0. density_y = p_j/A_j of the patch at y, 1/m^2; beside: of bundles from openings, 1/sr.
float cosine_over_density(float r, float cos_y, float density_y, float beside) {
    float blind = bundle.densities.x + bundle.densities.y * r + beside;
    return cos_y / (cos_y * blind + bundle.densities.z * density_y * r * r);
}

/// The same of a line that they do not have.
float cosine_over_density(float r, float cos_y, float density_y) {
    return cosine_over_density(r, cos_y, density_y, 0.0);
}

/// Bias for noise (ch. 5.4, eq. 5.6) with mean value substitution: where the shooter's probability p_j is below
/// F/(2M), the estimate is farther from its mean than the mean is from 0, and the mean takes its place.
/// irradiance: what one unit of the shooter's radiance brings, pi F/p_j; limit: 2 pi M, 0 = none.
float trade_bias_for_noise(float irradiance, float limit, float probability) {
    return limit > 0.0 && irradiance > limit ? irradiance * probability : irradiance;
}
