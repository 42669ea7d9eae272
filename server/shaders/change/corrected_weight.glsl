// SPDX-License-Identifier: Apache-2.0
// What a special phase adds to a mean, and how much it leaves of the mean's weight. A weight is a precision:
// the mean of weight w has the variance (s E)^2 / w; see solution_correct.comp.

#include "luminance.glsl"
#include "scene_geometry.glsl"
#include "mesh.glsl"
uniform uint place_before;  // first vertex of the place before
uniform float far_move;     // m: so far away the light is another one

const float sample_deviation = 0.4;  // s: of a sample of weight 1, relative to the mean

/// Share of an increment to add, so that the squared error is small: signal^2 / (signal^2 + noise^2) (Wiener 1949), where
/// r is the variance of the increment over its square, which holds the noise already. The square of the signal alone,
/// 1 - r of it, has an error of its own: steps of a drag of which one bundle has seen anything (r = 1) would never
/// be added, while the noise of many steps averages out.
float trusted_share(float noise) { return 1.0 / (1.0 + noise); }

/// The same for a patch on an object that has moved, whose change has this expected square. Bundles hit a small patch by a
/// few of their pixels or by none, at either place: that noise is the same however short the way, and adds up over the
/// steps of a drag. Beyond what was to be expected only what stands out of the noise counts.
float trusted_share_moved(float square, float variance, float expected) {
    const float sure = 9.0;  // three standard deviations
    float signal = expected + max(square - sure * variance, 0.0);
    return signal / max(signal + variance, 1e-30);
}

/// Squared error to expect of an increment of this square, of which the trusted share is added: that of its noise,
/// r / (1 + r)^2, and of what is not added, r^2 (1 - r) / (1 + r)^2. value: the mean. bundles_noise: 1/K; few bundles may
/// agree by chance, so that there is a least. Where one bundle alone has seen something, the unbiased estimate of what is
/// left would be too small; the more it has seen the less that is believed.
float left_error(float noise, float bundles_noise, float square, float value) {
    const float least_share = 0.4;
    const float much = 0.1;   // of the value
    const float most = 0.75;  // of the square: what doubt adds
    float r = clamp(noise, least_share * bundles_noise, 1.0);
    float doubt = most * square / max(square + much * much * value * value, 1e-30);
    return square * r * ((1.0 + r - r * r) / ((1.0 + r) * (1.0 + r)) + doubt * r * r);
}

/// The same of a patch on an object that has moved.
float left_error_moved(float variance, float expected) {
    return variance > 0.0 ? expected * variance / max(expected + variance, 1e-30) : expected;
}

/// Squared error of a mean on an object that has moved: few bundles reach its own sides, whose light has changed
/// the more the farther they have come.
/// triangle: one of them.
float moved_error(uint triangle, float value) {
    const float unknown = 0.2;  // of the value
    uint v = load_triangle(triangle).x;
    float way = distance(world_position(v), world_position(v + place_before));
    return unknown * unknown * value * value * min(way / far_move, 1.0);
}

/// Share of the weight that a mean keeps whose value is `value` now and whose increment had this variance.
float kept_weight(float weight, float value, float variance) {
    float deviation = sample_deviation * value;
    float samples = deviation * deviation;
    return samples > 0.0 || variance <= 0.0 ? samples / max(samples + weight * variance, 1e-30) : 0.0;
}
