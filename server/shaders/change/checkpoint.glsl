// SPDX-License-Identifier: Apache-2.0
// What a patch remembers of the solution before a change, and what is left to correct. A vec4:
//   x  luminance of the mean irradiance before
//   y  two floats of 16 bits: its weight then, and how far it has been from x in changes since that are
//      not settled yet
//   z  variance of the phase's increment over the square of that, 0: nothing has come in
//   w  two halves: the error that a phase has left, relative to correction_scale() (few bundles may bring a mean
//      down to nothing, from where it recovers), and the weight that the mean kept

#include "luminance.glsl"

/// Upper halves of two floats: their range with a precision of 0.4 %.
float pack_pair(vec2 v) {
    return uintBitsToFloat((floatBitsToUint(v.x) & 0xffff0000u) | floatBitsToUint(v.y) >> 16);
}

vec2 unpack_pair(float pair) {
    uint bits = floatBitsToUint(pair);
    return vec2(uintBitsToFloat(bits & 0xffff0000u), uintBitsToFloat(bits << 16));
}

float pack_left(float relative_error, float weight) {
    return uintBitsToFloat(packHalf2x16(min(vec2(relative_error, weight), 6e4)));
}

/// Size of the correction: of all changes that are not settled. A thing that has been moved there and back
/// has not been corrected by nothing.
float correction_size(vec4 c, float now) { return max(abs(now - c.x), unpack_pair(c.y).y); }

/// What errors and corrections of a patch are relative to: the most that it has had. Gloss, the difference from its
/// main part, may bring a dark patch below 0.
float correction_scale(vec4 c, float now) { return max(max(abs(now), abs(c.x)), max(unpack_pair(c.y).y, 1e-15)); }

/// Squared error that is left of it in a mean E = now of this weight. It consists of what the phases have left,
/// of weight k and error e E, and of samples since:
///   error^2 = (k e E / w)^2 + (s E)^2 ((w - k) / w^2 - 1/w0),
/// where what the mean had before the change, with the weight w0, is no part of the correction.
float correction_left(vec4 c, float now, float weight) {
    const float patch_deviation = 0.7;  // s: of patches, relative to the mean
    float deviation = patch_deviation * now;
    float weight_before = unpack_pair(c.y).x;
    float before = weight_before > 0.0 ? 1.0 / weight_before : 0.0;
    vec2 left = unpackHalf2x16(floatBitsToUint(c.w));
    float kept = min(left.y / weight, 1.0);
    float error = deviation * deviation * max((1.0 - kept) / weight - before, 0.0);
    float kept_error = kept * left.x * correction_scale(c, now);
    error += kept_error * kept_error;
    float size = correction_size(c, now);
    // One change leaves no more than it is worth itself; the noise of many small ones adds up beyond that.
    return unpack_pair(c.y).y > 0.0 ? error : min(error, size * size);
}
