// SPDX-License-Identifier: Apache-2.0
// What a special phase adds to a mean, and how much it leaves of the mean's weight. A weight is a precision:
// the mean of weight w has the variance (s E)^2 / w; see solution_correct.comp.

#include "scene_geometry.glsl"
#include "mesh.glsl"
uniform uint place_before;  // first vertex of the place before
uniform float far_move;     // m: so far away the light is another one

const float sample_deviation = 0.4;  // s: of a sample of weight 1, relative to the mean

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

/// Share of an increment to add, so that the squared error is least (Wiener 1949): 1 - r, where r is the
/// variance of the increment over its square. A few bundles that disagree say little, and where only one of
/// them has seen anything at all the light stays what it was.
float trusted_share(float noise) { return clamp(1.0 - noise, 0.0, 1.0); }

/// Squared error to expect of an increment of this square, of which the trusted share is added: that of its
/// noise and of what is not added. value: the mean. bundles_noise: 1/K; few bundles may agree by chance, so that
/// there is a least. Where one bundle alone has seen something, the unbiased estimate of what is left would be 0;
/// the more it has seen the less that is believed.
float left_error(float noise, float bundles_noise, float square, float value) {
    const float least_share = 0.4;
    const float much = 0.1;  // of the value
    float r = clamp(noise, least_share * bundles_noise, 1.0);
    float doubt = square / max(square + much * much * value * value, 1e-30);
    return square * r * (1.0 - r + doubt * r * r);
}

/// Squared error of a mean on an object that has moved: few bundles reach its own sides, whose light has changed
/// the more the farther they have come.
float moved_error(uint patch_id, float value) {
    const float unknown = 0.2;  // of the value
    uint v = load_triangle(floatBitsToUint(patch_attributes(patch_id).w)).x;
    float way = distance(world_position(v), world_position(v + place_before));
    return unknown * unknown * value * value * min(way / far_move, 1.0);
}

/// Share of the weight that a mean keeps whose value is `value` now and whose increment had this variance.
float kept_weight(float weight, float value, float variance) {
    float deviation = sample_deviation * value;
    float samples = deviation * deviation;
    return samples > 0.0 || variance <= 0.0 ? samples / max(samples + weight * variance, 1e-30) : 0.0;
}
