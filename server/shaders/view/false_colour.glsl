// SPDX-License-Identifier: Apache-2.0
#include "luminance.glsl"

/// What lies above the scale, and below it: neither is a colour of the map.
const vec3 ABOVE_SCALE = vec3(1.0), BELOW_SCALE = vec3(0.0);

/// Polynomial fit of the perceptually even map "turbo" (A. Mikhailov 2019, Google), from `begin` to `maximum`: logarithmic, or linear
/// where the scale begins at 0.
vec3 false_colour(float value, float begin, float maximum) {
    if (value > maximum) return ABOVE_SCALE;
    if (value < begin) return BELOW_SCALE;
    float x = begin > 0.0 ? log(value / begin) / log(maximum / begin) : value / maximum;
    vec4 v4 = vec4(1.0, x, x * x, x * x * x);
    vec2 v2 = v4.zw * v4.z;
    return clamp(vec3(dot(v4, vec4(0.13572138, 4.61539260, -42.66032258, 132.13108234)) + dot(v2, vec2(-152.94239396, 59.28637943)),
                      dot(v4, vec4(0.09140261, 2.19418839, 4.84296658, -14.18503333)) + dot(v2, vec2(4.27729857, 2.82956604)),
                      dot(v4, vec4(0.10667330, 12.64194608, -60.58204836, 110.36276771)) + dot(v2, vec2(-89.90310912, 27.34824973))),
                 0.0, 1.0);
}

/// Which of the bands between 1, 2 and 5 times the powers of ten a value lies in, within the three
/// decades below `maximum`.
float isoline_band(float value, float maximum) {
    float decades = log(clamp(value, 1e-3 * maximum, maximum)) / log(10.0);
    float part = fract(decades);
    return 3.0 * floor(decades) + (part < 0.30103 ? 0.0 : part < 0.69897 ? 1.0 : 2.0);
}
