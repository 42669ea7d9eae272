// SPDX-License-Identifier: Apache-2.0
// Selection probability of shooting patches (ch. 5.3): proportional to luminance power, half of it shared among zones by
// area (solution/store/shooting_shares.h), with a defensive share for area and for emitting area, so that no light is starved,
// however dim beside others, and a black scene still samples.
#include "luminance.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
#include "patch_source.glsl"
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
#ifndef CHANGE
#include "zone_level.glsl"
layout(std430, binding = BINDING_BALANCE) readonly buffer BalanceBuffer { Balance balance; };
#endif
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
/// Per block of POWER_BLOCK patches: xyz = power, area, emitting area; w = probability of all blocks
/// before it. One more element holds the totals.
layout(std430, binding = BINDING_POWER) buffer PowerBuffer { vec4 blocks[]; };


const float pi = 3.14159265359;
// CHANGE: what a special phase sends, of either sign, and no more shooters than that needs.
#ifdef CHANGE
const float defensive_share = 0.0;
#else
const float defensive_share = 0.1;
#endif

/// Where a patch is larger: at the present place or, in a special phase, before. What shrinks to nothing still
/// has its old light to take back.
uint larger_place(uint i) {
    uint before = uint(patches.length()) / 2u + i;
    return patches[before].area > patches[i].area ? before : i;
}

/// p_j / A_j at a place (index: patch + base of the place) of a patch of this density where it is larger.
float density_at(uint index, uint larger, float density) {
    bool same = patches[index].area == patches[larger].area;
    return same ? density : density * patches[larger].area * patches[index].inverse_area;
}

/// Power (luminance, radiance units * m^2), area and emitting area (m^2) of a patch.
vec3 patch_power(uint i) {
    float emitting = luminance(patch_source(i)) > 0.0 ? 1.0 : 0.0;
    float area = patches[larger_place(i)].area;
#ifdef CHANGE
    return vec3(pi * luminance(abs(radiance[i].rgb)) * area, area, emitting * area);
#else
    float factor = zone_levels[zones[i]].shooting.x;
    return vec3(factor * pi * luminance(abs(radiance[i].rgb - balance.constant.rgb)) * area, area, emitting * area);
#endif
}

/// Probability of (sums of) patch_power, given the totals.
float selection_probability(vec3 power, vec3 total) {
    float by_area = total.y > 0.0 ? power.y / total.y : 0.0;
    float by_power = total.x > 0.0 ? power.x / total.x : by_area;
    float by_emission = total.z > 0.0 ? power.z / total.z : by_area;
    return mix(by_power, 0.5 * (by_area + by_emission), defensive_share);
}
