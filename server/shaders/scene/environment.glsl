// SPDX-License-Identifier: Apache-2.0
// What an eye sees beyond the scene: an equirectangular picture of the environment, and the sun's disc.
// Row 0 is the zenith, the middle column north (-Z); see scene/light/environment_map.h.
layout(binding = UNIT_ENVIRONMENT) uniform sampler2D environment_texels;

/// Radiance from a unit direction, cd/m^2.
vec3 environment_radiance(vec3 direction) {
    const float inverse_pi = 0.31830988618;
    float azimuth = direction.x != 0.0 || direction.z != 0.0 ? atan(direction.x, -direction.z) : 0.0;
    vec2 at = vec2(0.5 * azimuth * inverse_pi + 0.5, acos(clamp(direction.y, -1.0, 1.0)) * inverse_pi);
    vec3 sum = textureLod(environment_texels, at, 0.0).rgb;
    return dot(direction, view.sun.xyz) > view.sun.w && direction.y >= 0.0 ? sum + view.sun_radiance.rgb : sum;
}
