// SPDX-License-Identifier: Apache-2.0
// Luminous intensities of photometric files, see IES_ROWS.
layout(std430, binding = BINDING_IES) readonly buffer IesBuffer { float ies_candela[]; };

/// Luminous intensity, cd, of a profile towards a unit direction in the light's own axes, away from it.
float ies_intensity(uint profile, vec3 d) {
    const float degrees_per_radian = 57.295779513;
    float row = acos(clamp(-d.z, -1.0, 1.0)) * (2.0 * degrees_per_radian);
    float turn = dot(d.xy, d.xy) > 0.0 ? atan(d.y, d.x) * degrees_per_radian : 0.0;
    float column = (turn < 0.0 ? turn + 360.0 : turn) * 0.4;
    uint r = min(uint(row), uint(IES_ROWS - 2));
    uint c = min(uint(column), uint(IES_COLUMNS - 2));
    uint first = (profile * uint(IES_COLUMNS) + c) * uint(IES_ROWS) + r;
    float low = mix(ies_candela[first], ies_candela[first + 1u], row - float(r));
    float high = mix(ies_candela[first + uint(IES_ROWS)], ies_candela[first + uint(IES_ROWS) + 1u], row - float(r));
    return mix(low, high, column - float(c));
}
