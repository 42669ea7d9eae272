// SPDX-License-Identifier: Apache-2.0
// From exposed light to displayed light, as view/image/tone_curve.h. Walkthroughs have this text, too: GLSL ES 3.0.

/// Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", eq. 4, per channel: nearly
/// linear in the shadows, soft shoulder, 1 at `white`.
vec3 shoulder(vec3 x) {
    const float white = 6.0;
    return x * (1.0 + x / (white * white)) / (1.0 + x);
}

/// sRGB encoding by square roots (I. Chilliant 2012), within 0.2 % of the exact curve.
vec3 srgb_encoded(vec3 c) {
    c = clamp(c, 0.0, 1.0);
    vec3 s1 = sqrt(c);
    vec3 s2 = sqrt(s1);
    vec3 s3 = sqrt(s2);
    return 0.662002687 * s1 + 0.684122060 * s2 - 0.323583601 * s3 - 0.0225411470 * c;
}
