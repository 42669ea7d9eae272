// SPDX-License-Identifier: Apache-2.0
// The surface lists of a parallel bundle, in no order. The axis z of the bundle points away from the
// window's origin; "far-facing" surfaces have their front towards +z.

layout(std430, binding = BINDING_LAYER_COUNTS) buffer CountBuffer { uint layer_counts[]; };
layout(std430, binding = BINDING_LAYER_SURFACES) buffer SurfaceListBuffer { uint layer_surfaces[]; };

/// Place of the k-th surface of a pixel's line.
uint layer_slot(uint k, uint pixel) { return k * bundle.resolution.x * bundle.resolution.y + pixel; }

/// Surfaces that a pixel has room for.
uint layer_capacity() { return bundle.resolution.z; }

const float beyond_all = 1e30;

/// The window's x, y, z are right-handed with z away from it, which shows the scene mirrored: a triangle
/// that is counter-clockwise in the window has its front towards +z.
bool faces_far(uint surface) { return (surface & 1u) == 0u; }

/// Where a line along the axis meets a facet's plane: distance from `point` along the axis. A plane seen
/// edge-on has no projected area, so that what its depth is does not matter.
float plane_depth(vec4 plane, vec3 point) {
    float along = dot(plane.xyz, bundle.axis_z.xyz);
    return (plane.w - dot(plane.xyz, point)) / (abs(along) > 1e-7 ? along : 1e-7);
}

/// Surface on the side of a triangle that looks towards +z (far = true) or -z, as seen of `surface`.
uint side_of_surface(uint surface, bool far) { return far == faces_far(surface) ? 0u : 1u; }
