// SPDX-License-Identifier: Apache-2.0
// Requires scene_geometry.glsl and facets.glsl.

/// Side where a ray from the eye meets a rasterised surface, or NO_PATCH: see side_of_triangle().
uint side_seen(uint surface, vec3 eye, vec3 direction) {
    Facet facet = load_facet(surface >> 1);
    float height = facet.plane.w - dot(facet.plane.xyz, eye);
    float along = dot(facet.plane.xyz, direction);
    float t = along != 0.0 ? height / along : 0.0;
    return side_of_triangle(2u * triangle_at(facet, eye + t * direction) + (surface & 1u));
}
