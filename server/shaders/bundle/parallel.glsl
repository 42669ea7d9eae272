// SPDX-License-Identifier: Apache-2.0
// Geometry of parallel bundles. The axis z points away from the window's origin, and the scene lies
// between z = 0 and z = R; "far-facing" surfaces have their front towards +z.

/// Point in the window's plane that a pixel samples.
vec3 window_point(uvec2 pixel) {
    vec2 at = (vec2(pixel) + 0.5) * bundle.weights.z;
    return bundle.origin.xyz + at.x * bundle.axis_x.xyz + at.y * bundle.axis_y.xyz;
}

/// The window's x, y, z are right-handed with z away from it, which shows the scene mirrored: a triangle
/// that is counter-clockwise in the window has its front towards +z.
bool faces_far(uint surface) { return (surface & 1u) == 0u; }

/// Mark of a surface that the rasteriser has turned over (folded_over) and that is turned back. It receives
/// with the opposite sign.
const uint turned_over = 1u << 31;

bool is_turned_over(uint surface) { return surface >= turned_over && surface != NO_HIT; }

uint facet_of(uint surface) { return surface >> 1 & 0x3fffffffu; }

/// The rasteriser rounds corners to fractions of a pixel, which turns over triangles that are hardly as wide:
/// their fragments say that the surface faces the other way. Taken at their word they would carry light
/// through walls. Where triangles are wide it happens at the most grazing angles only.
bool folded_over(uint surface, vec4 plane) {
    return (dot(plane.xyz, bundle.axis_z.xyz) > 0.0) != faces_far(surface);
}

/// Where a line along the axis meets a facet's plane: distance from `point` along the axis. A plane seen
/// edge-on has no projected area, so that what its depth is does not matter.
float plane_depth(vec4 plane, vec3 point) {
    float along = dot(plane.xyz, bundle.axis_z.xyz);
    return (plane.w - dot(plane.xyz, point)) / (abs(along) > 1e-7 ? along : 1e-7);
}

/// Surface on the side of a triangle that looks towards +z (far = true) or -z, as seen of `surface`.
uint side_of_surface(uint surface, bool far) { return far == faces_far(surface) ? 0u : 1u; }

#ifdef SKY
#include "sky_openings.glsl"
#endif

/// Radiance of a line that meets nothing, from far along +z or -z.
vec3 sky_radiance(bool far) { return far ? bundle.sky.rgb : bundle.sky_behind.rgb; }

/// d(omega) of a line that meets nothing beyond x, at a depth of the window's slab: as if the sky were where the slab
/// ends, since that is the farthest that a plane can lie. Bundles from openings to the sky may have the line, too.
float sky_density(vec3 x, float depth, bool far) {
    float density = bundle.densities.x + bundle.densities.y * (far ? bundle.axis_y.w - depth : depth);
#ifdef SKY
    density += opening_density(x, far ? bundle.axis_z.xyz : -bundle.axis_z.xyz, 1e12);
#endif
    return density;
}
