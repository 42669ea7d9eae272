// SPDX-License-Identifier: Apache-2.0
// Light of a luminaire's opening at a point: the mean over the opening of what its points bring, by Gauss-Legendre
// quadrature of n x n points. Part of first_shot.glsl.
//
// What a point x of a Lambert surface brings to a parallel one is 1/|x - p|^4 times a constant. In powers of h/r, half the
// side over the distance, that is a sum of Gegenbauer polynomials C_k^(2), at most (k + 1)(k + 2)(k + 3)/6, and n points
// are exact for k < 2n; of k = 2n they leave (2^n n!^2)^2 / ((2n + 1) (2n)!^2). Summed over all k, in the worst direction
// and for squares as for strips, h/r may be up to 0.0388, 0.1988, 0.3707, 0.483, 0.546 with 1 to 5 points along a side for
// an error of 0.5 %, the bound of the photometric tests. `reach` is h times how much steeper the intensity is than a
// Lambert surface's.

/// (node, weight) in [0, 1] of 1, 2, ... 6 points.
const vec2 gauss_points[21] = vec2[21](
    vec2(0.5, 1.0),
    vec2(0.2113248654, 0.5), vec2(0.7886751346, 0.5),
    vec2(0.1127016654, 0.2777777778), vec2(0.5, 0.4444444444), vec2(0.8872983346, 0.2777777778),
    vec2(0.0694318442, 0.1739274226), vec2(0.3300094782, 0.3260725774), vec2(0.6699905218, 0.3260725774),
    vec2(0.9305681558, 0.1739274226),
    vec2(0.0469100770, 0.1184634425), vec2(0.2307653449, 0.2393143352), vec2(0.5, 0.2844444444),
    vec2(0.7692346551, 0.2393143352), vec2(0.9530899230, 0.1184634425),
    vec2(0.0337652429, 0.0856622462), vec2(0.1693953068, 0.1803807865), vec2(0.3806904070, 0.2339569673),
    vec2(0.6193095930, 0.2339569673), vec2(0.8306046932, 0.1803807865), vec2(0.9662347571, 0.0856622462));

/// Points along a side, by the square of r/reach.
uint opening_order(float ratio) {
    return 1u + uint(ratio < 666.0) + uint(ratio < 25.3) + uint(ratio < 7.28) + uint(ratio < 4.29) + uint(ratio < 3.36);
}

/// Where a point of [0, 1]^2 lies, along axis_x and axis_y from the light's position. quarter: of an ellipse.
vec2 opening_point(PunctualData light, vec2 u, uint quarter) {
    if (light.profile.z == OPENING_RECTANGLE) {
        return light.opening.xy + light.opening.zw * (2.0 * u - 1.0);
    }
    float angle = 1.5707963268 * u.y;  // equal areas
    vec2 on = sqrt(u.x) * vec2(cos(angle), sin(angle));
    vec2 side = vec2((quarter & 1u) == 0u ? 1.0 : -1.0, (quarter & 2u) == 0u ? 1.0 : -1.0);
    return light.opening.xy + light.opening.zw * (light.profile.z == OPENING_QUARTER ? on : side * on);
}

/// The middle of gravity of the opening.
vec2 opening_middle(PunctualData light) {
    const float quarter_middle = 0.4244131816;  // 4/(3 pi)
    return light.opening.xy + (light.profile.z == OPENING_QUARTER ? quarter_middle * light.opening.zw : vec2(0.0));
}

/// Irradiance (radiance units) of a surface of this normal at a point, without obstacles.
vec3 opening_irradiance(PunctualData light, vec3 position, vec3 normal) {
    mat2x3 axes = mat2x3(light.axis_x.xyz, light.axis_y.xyz);
    vec3 whole = light.position.xyz;
    vec3 d = whole + axes * light.opening.xy - position;
    uint order = opening_order(dot(d, d) / (light.axis_z.w * light.axis_z.w));
    uint quarters = light.profile.z == OPENING_ELLIPSE && order > 1u ? 4u : 1u;
    uint points = quarters * order * order;
    uint first = (order * (order - 1u)) / 2u;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < points; ++i) {
        uint within = i / quarters;
        vec2 along = gauss_points[first + within % order];
        vec2 across = gauss_points[first + within / order];
        vec2 aside = order > 1u ? opening_point(light, vec2(along.x, across.x), i % quarters) : opening_middle(light);
        light.position.xyz = whole + axes * aside;
        vec3 to_point;
        vec3 arriving = facing_illuminance(light, position, to_point);
        sum += arriving * (along.y * across.y * max(dot(normal, normalize(to_point)), 0.0));
    }
    return sum / float(quarters);
}
