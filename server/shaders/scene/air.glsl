// SPDX-License-Identifier: Apache-2.0
// Air that absorbs and scatters (MEDIUM; scene/medium.h), in the box that holds the scene: what is left of light on
// its way. Surfaces are all in the box. What is scattered comes by single paths (solution/air/, view/air_view.h).
#ifdef MEDIUM
/// Of so many metres within the box.
float left_by_air(float metres) { return exp(-AIR_EXTINCTION * metres); }

/// Of a way that begins anywhere and goes `end` metres along a unit direction.
float left_by_air_along(vec3 from, vec3 direction, float end) {
    vec3 inverse = 1.0 / mix(direction, vec3(1e-20), equal(direction, vec3(0.0)));
    vec3 a = (AIR_LOW - from) * inverse;
    vec3 b = (AIR_HIGH - from) * inverse;
    vec3 low = min(a, b), high = max(a, b);
    float first = max(max(max(low.x, low.y), low.z), 0.0);
    float last = min(min(min(high.x, high.y), high.z), end);
    return left_by_air(max(last - first, 0.0));
}

/// Of light from the sky.
float left_by_air_from_sky(vec3 at, vec3 to_sky) { return left_by_air_along(at, to_sky, 1e30); }

/// Of light between two points, either of which may be outside.
float left_by_air_between(vec3 a, vec3 b) {
    vec3 way = b - a;
    float metres = length(way);
    return metres > 0.0 ? left_by_air_along(a, way / metres, metres) : 1.0;
}
#endif
