// SPDX-License-Identifier: Apache-2.0
// Air between a viewer's eye and what its pixels show (view/air_view.h): it takes away some of that light, and sends
// some of its own, in proportion to what it takes away. Needs the view parameters.
#include "air.glsl"
/// 0: columns, rows, pixels along an edge of one of theirs, relative variance; then radiance that endless air would
/// send, radiance units, and the share that the air takes away.
layout(binding = UNIT_PIXEL_AIR) uniform samplerBuffer pixel_air_texels;

float left_before(vec3 position) { return left_by_air_between(view.eye.xyz, position); }

float left_before_sky(uint index) {
    uvec2 at = uvec2(index % view.size.x, index / view.size.x);
    return left_by_air_from_sky(view.eye.xyz, normalize(view_direction(at, place_in_pixel(at))));
}

float relative_variance_of_air() { return texelFetch(pixel_air_texels, 0).w; }

/// What is known of the air before a pixel.
vec4 air_before(uint index) {
    vec4 head = texelFetch(pixel_air_texels, 0);
    uvec2 at = uvec2(index % view.size.x, index / view.size.x) / max(uint(head.z), 1u);
    return texelFetch(pixel_air_texels, 1 + int(at.y * uint(head.x) + at.x));
}

/// Radiance that the air sends to a pixel; left: of what lies behind it.
vec3 sent_by_air(uint index, float left) { return (1.0 - left) * air_before(index).rgb; }

/// The same before something black whose place is not known.
vec3 sent_by_air_before_black(uint index) {
    vec4 air = air_before(index);
    return air.w * air.rgb;
}
