// SPDX-License-Identifier: Apache-2.0
// From exposed light to displayed light, as view/image/tone_curve.h.

/// Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", eq. 4, per channel: nearly
/// linear in the shadows, soft shoulder, 1 at `white`.
vec3 shoulder(vec3 x) {
    const float white = 6.0;
    return x * (1.0 + x / (white * white)) / (1.0 + x);
}
