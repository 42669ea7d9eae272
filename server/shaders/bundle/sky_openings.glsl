// SPDX-License-Identifier: Apache-2.0
// Openings that light of the sky passes on its way to surfaces (zones/sky_openings.h). Bundles start there, too, and see the
// lines of which those of random directions find few; the density of a line is the sum over both kinds.
#ifdef GLOSSY
#include "reflectors.glsl"
#endif
layout(std140, binding = BINDING_OPENINGS) uniform OpeningBlock { OpeningParameters openings; };
layout(std430, binding = BINDING_SHELTERED) readonly buffer ShelteredBuffer { uint sheltered[]; };  // a bit for each patch

/// Density at x, 1/sr, that bundles from openings have of the line in a unit direction, as far as it is free: each opening
/// adds the density of points in it times the integral of r^2 over its part of the line.
float opening_density(vec3 x, vec3 towards, float reach) {
    float sum = 0.0;
    for (uint k = 0u; k < openings.number.x; ++k) {
        SkyOpening o = openings.opening[k];
        vec3 from = x - o.corner.xyz;
        vec3 at = vec3(dot(from, o.across_u.xyz), dot(from, o.across_v.xyz), dot(from, o.across_w.xyz));
        vec3 step = vec3(dot(towards, o.across_u.xyz), dot(towards, o.across_v.xyz), dot(towards, o.across_w.xyz));
        vec3 inverse = 1.0 / mix(step, vec3(1e-20), lessThan(abs(step), vec3(1e-20)));
        vec3 a = -at * inverse;
        vec3 b = (1.0 - at) * inverse;
        vec3 low = min(a, b), high = max(a, b);
        float near = max(max(max(low.x, low.y), low.z), 0.0);
        float far = min(min(min(high.x, high.y), high.z), reach);
        bool passes = far > near && dot(o.inward.xyz, towards) < 0.0;
        sum += passes ? o.corner.w * (far - near) * (near * near + near * far + far * far) / 3.0 : 0.0;
    }
    return sum;
}

bool is_sheltered(uint patch_id) { return (sheltered[patch_id >> 5] >> (patch_id & 31u) & 1u) != 0u; }

/// Whether bundles from openings carry what patch y sends to patch x: from what the sky lights to what sees little of it.
bool openings_carry(uint y, uint x) {
    if (openings.number.x == 0u || x == NO_PATCH || y == NO_PATCH || !is_sheltered(x) || is_sheltered(y)) {
        return false;
    }
#ifdef GLOSSY  // whose radiance depends on direction
    return !is_glossy(y);
#else
    return true;
#endif
}

/// Density of the line from x, on a patch, to patch y, at a distance in a unit direction, that bundles from openings have.
float density_beside(uint patch_x, vec3 x, uint patch_y, vec3 towards, float distance) {
    return openings_carry(patch_y, patch_x) ? opening_density(x, towards, distance) : 0.0;
}
