// SPDX-License-Identifier: Apache-2.0
// Rasterisers snap vertices to 1/256 pixel, so that walls that meet in a corner but share no vertices can
// leave a gap of that width; through it a thin wall would leak. Nothing is transferred to or from a point
// within four times that distance of a crease (or open edge) of its own surface: a strip far too thin to
// matter for the light that does belong there. Only compiled where a scene has walls thin enough to need
// it (THIN_WALLS).

#include "mesh.glsl"

const float snap_distance = 0.015625;  // pixels

uint crease_flags(uint triangle) { return load_triangle(triangle).w >> CREASE_SHIFT; }

/// Whether the line through point along direction (any length) passes a flagged edge of the triangle
/// closer than `distance_limit`.
bool near_crease(uint triangle, uint flags, uint vertex_base, vec3 point, vec3 direction, float distance_limit) {
    uvec3 v = load_triangle(triangle).xyz + vertex_base;
    vec3 p[3] = vec3[3](world_position(v.x), world_position(v.y), world_position(v.z));
    for (uint k = 0u; k < 3u; ++k) {
        if ((flags >> k & 1u) == 0u) {
            continue;
        }
        vec3 a = p[(k + 1u) % 3u];
        vec3 m = cross(p[(k + 2u) % 3u] - a, direction);
        float volume = dot(m, point - a);
        if (volume * volume <= distance_limit * distance_limit * dot(m, m)) {
            return true;
        }
    }
    return false;
}

/// Factor that makes up for the strips along flagged edges: projected area over what the strips leave
/// of it. direction: unit, along the bundle's lines; pixel_width at the triangle, m.
float crease_compensation(uint triangle, uint flags, uint vertex_base, vec3 direction, float pixel_width) {
    uvec3 v = load_triangle(triangle).xyz + vertex_base;
    vec3 p[3] = vec3[3](world_position(v.x), world_position(v.y), world_position(v.z));
    float area = 0.5 * abs(dot(cross(p[1] - p[0], p[2] - p[0]), direction));
    float strip = 0.0;
    for (uint k = 0u; k < 3u; ++k) {
        if ((flags >> k & 1u) != 0u) {
            strip += length(cross(p[(k + 2u) % 3u] - p[(k + 1u) % 3u], direction));
        }
    }
    strip *= snap_distance * pixel_width;
    return area / max(area - strip, 0.5 * area);
}
