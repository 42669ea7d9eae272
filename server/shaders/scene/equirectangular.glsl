// SPDX-License-Identifier: Apache-2.0
// Place of a unit direction in an equirectangular picture: row 0 is the zenith, the middle column north (-Z); see
// scene/light/environment_map.h.
vec2 equirectangular(vec3 direction) {
    const float inverse_pi = 0.31830988618;
    float azimuth = direction.x != 0.0 || direction.z != 0.0 ? atan(direction.x, -direction.z) : 0.0;
    return vec2(0.5 * azimuth * inverse_pi + 0.5, acos(clamp(direction.y, -1.0, 1.0)) * inverse_pi);
}
