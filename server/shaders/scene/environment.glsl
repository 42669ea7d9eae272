// SPDX-License-Identifier: Apache-2.0
// What an eye sees beyond the scene: an equirectangular picture of the environment, and the sun's disc.
#include "equirectangular.glsl"
layout(binding = UNIT_ENVIRONMENT) uniform sampler2D environment_texels;

/// Radiance from a unit direction, cd/m^2.
vec3 environment_radiance(vec3 direction) {
    vec3 sum = textureLod(environment_texels, equirectangular(direction), 0.0).rgb;
    return dot(direction, view.sun.xyz) > view.sun.w && direction.y >= 0.0 ? sum + view.sun_radiance.rgb : sum;
}
