// SPDX-License-Identifier: Apache-2.0
// How much a special phase leaves of a mean's weight; see solution_correct.comp.

const float sample_deviation = 0.5;  // s: of one sample, relative to the mean

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

/// Share of the weight that a mean keeps whose value is `value` now and whose increment had this variance.
float kept_weight(float weight, float value, float variance) {
    float deviation = sample_deviation * value;
    float samples = deviation * deviation;
    return samples > 0.0 || variance <= 0.0 ? samples / max(samples + weight * variance, 1e-30) : 0.0;
}
