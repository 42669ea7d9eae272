// SPDX-License-Identifier: Apache-2.0
// Where a viewer's pixels are looked at: at their centres, or where they are parts of the pixels of a final picture
// at staggered places (view/filters/sub_samples.h). Needs the view parameters.

/// From the centre of a pixel, pixels.
vec2 place_in_pixel(uvec2 at) {
    uint k = STAGGER_PERIOD * (at.y % STAGGER_PERIOD) + at.x % STAGGER_PERIOD;
    vec4 two = view.places[k >> 1];
    return (k & 1u) == 0u ? two.xy : two.zw;
}

/// Direction from the eye, not of unit length. place: from the pixel's centre, pixels.
vec3 view_direction(uvec2 at, vec2 place) {
    vec2 ndc = (vec2(at) + 0.5 + place) / vec2(view.size.xy) * 2.0 - 1.0;
    return view.forward.xyz + ndc.x * view.right.xyz + ndc.y * view.up.xyz;
}
