// SPDX-License-Identifier: Apache-2.0
// Layered parallel bundle to patches (ch. 4.3, 4.3.1): consecutive, mutually facing surfaces exchange
// radiance both ways:  irradiance_i += L(y) (pixel area / A_i) / d(omega)   (cos_x dA_x = pixel area).
// Lines that meet nothing carry the sky's radiance.
//
// Each pixel's list is sorted by depth first. Surfaces that coincide are ordered so that the one facing
// the window comes first: then a thin wall is a wall, not a gap that two surfaces exchange light through
// (figure 4.4). Ties beyond that break by surface number, so that the order in which fragments arrived
// never shows.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "accumulator.glsl"
#include "density.glsl"
#include "scene_geometry.glsl"
#include "facets.glsl"
#include "layers.glsl"
#ifdef THIN_WALLS
#include "crease.glsl"
#endif
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;  // along the bundle
uniform uint first_column;
uniform uint first_row;
uniform uint columns;
uniform uint rows;
uniform uint row_stride;  // rows are sampled: every row_stride-th from row_phase on
uniform uint row_phase;
uniform uint patch_base;
uniform uint facet_base;
uniform uint vertex_base;
uniform uint slot;  // of the iteration in its group

/// A line of the bundle and what it carries.
struct Line {
    uint pixel;
    vec3 point;        // in the window's plane
    float pixel_area;  // m^2
};

/// A surface that a line meets.
struct Hit {
    float depth;
    uint surface;
};

bool before(Hit a, Hit b) { return a.depth != b.depth ? a.depth < b.depth : a.surface < b.surface; }

Hit load_hit(Line line, uint k) {
    uint surface = layer_surfaces[layer_slot(k, line.pixel)];
    return Hit(plane_depth(facet_plane(facet_base + (surface >> 1)), line.point), surface);
}

void store_hit(Line line, uint k, Hit hit) { layer_surfaces[layer_slot(k, line.pixel)] = hit.surface; }

void order(inout Hit a, inout Hit b) {
    if (before(b, a)) {
        Hit c = a;
        a = b;
        b = c;
    }
}

/// True where two surfaces are one plane, back to back.
bool coincide(uint surface_a, uint surface_b) {
    vec4 a = facet_plane(facet_base + (surface_a >> 1));
    vec4 b = facet_plane(facet_base + (surface_b >> 1));
    return dot(a.xyz, b.xyz) < -0.999999 && abs(a.w + b.w) <= bundle.sky.w;
}

/// Puts the surface that faces the window before the one it coincides with.
void order_coincident(inout Hit a, inout Hit b) {
#ifdef THIN_WALLS
    if (faces_far(a.surface) && !faces_far(b.surface) && b.depth <= a.depth + 16.0 * bundle.weights.z &&
        coincide(a.surface, b.surface)) {
        uint surface = a.surface;
        a.surface = b.surface;
        b.surface = surface;
    }
#endif
}

/// Insertion sort of a long list, in memory.
void sort_list(Line line, uint count) {
    for (uint i = 1u; i < count; ++i) {
        Hit hit = load_hit(line, i);
        uint k = i;
        for (; k > 0u; --k) {
            Hit other = load_hit(line, k - 1u);
            if (!before(hit, other)) {
                break;
            }
            store_hit(line, k, other);
        }
        store_hit(line, k, hit);
    }
#ifdef THIN_WALLS
    for (uint i = 0u; i + 1u < count; ++i) {
        Hit a = load_hit(line, i);
        for (uint k = i + 1u; k < count && faces_far(a.surface); ++k) {
            Hit b = load_hit(line, k);
            order_coincident(a, b);
            store_hit(line, k, b);
        }
        store_hit(line, i, a);
    }
#endif
}

/// 0 where the line passes too close to a crease of the triangle, else the factor that makes up for it.
float crease_factor(uint triangle, vec3 point) {
#ifdef THIN_WALLS
    uint flags = crease_flags(triangle);
    vec3 axis = bundle.axis_z.xyz;
    return near_crease(triangle, flags, vertex_base, point, axis, snap_distance * bundle.weights.z)
               ? 0.0
               : crease_compensation(triangle, flags, vertex_base, axis, bundle.weights.z);
#else
    return 1.0;
#endif
}

void deposit(uint patch_id, vec3 irradiance) {
    vec3 value = irradiance * (patch_attributes(patch_base + patch_id).y * bundle.weights.x);
    accumulate(patch_id, 0u, value.r);
    accumulate(patch_id, 1u, value.g);
    accumulate(patch_id, 2u, value.b);
}

uint triangle_of(Line line, Facet facet, float depth) {
    return triangle_at(facet, line.point + depth * bundle.axis_z.xyz);
}

/// Whether any radiance passes between two consecutive surfaces.
bool face_each_other(Hit a, Hit b) {
#ifdef DOUBLE_SIDED
    return b.depth < beyond_all && b.depth - a.depth > bundle.sky.w;
#else
    return faces_far(a.surface) && !faces_far(b.surface) && b.depth < beyond_all && b.depth - a.depth > bundle.sky.w;
#endif
}

void exchange(Line line, Hit hit_a, Hit hit_b) {
    Facet facet_a = load_facet(facet_base + (hit_a.surface >> 1));
    Facet facet_b = load_facet(facet_base + (hit_b.surface >> 1));
    uint triangle_a = triangle_of(line, facet_a, hit_a.depth);
    uint triangle_b = triangle_of(line, facet_b, hit_b.depth);
    uint a = patch_of_surface(2u * triangle_a + side_of_surface(hit_a.surface, true));
    uint b = patch_of_surface(2u * triangle_b + side_of_surface(hit_b.surface, false));
    if (a == NO_PATCH || b == NO_PATCH) {
        return;
    }
    float r = hit_b.depth - hit_a.depth;
    float cos_a = abs(dot(facet_a.plane.xyz, bundle.axis_z.xyz));
    float cos_b = abs(dot(facet_b.plane.xyz, bundle.axis_z.xyz));
    float area = line.pixel_area * crease_factor(triangle_a, line.point) * crease_factor(triangle_b, line.point);
    vec4 la = texelFetch(radiance_texels, int(a));
    vec4 lb = texelFetch(radiance_texels, int(b));
    // 1/d(omega) for x on a, y on b, and the other way round.
    deposit(a, lb.rgb * (area * cosine_over_density(r, cos_b, lb.w)));
    deposit(b, la.rgb * (area * cosine_over_density(r, cos_a, la.w)));
}

#ifdef SKY
void receive_sky(Line line, Hit hit, bool far) {
    Facet facet = load_facet(facet_base + (hit.surface >> 1));
    uint id = patch_of_surface(2u * triangle_of(line, facet, hit.depth) + side_of_surface(hit.surface, far));
    float density = sky_density(hit.depth, far);
    if (id != NO_PATCH && density > 0.0) {
        deposit(id, bundle.sky.rgb * (line.pixel_area / density));
    }
}
#endif

void transfer(Line line, uint count) {
    const uint held = 4u;  // surfaces kept at hand; longer lists are sorted in memory
    Hit nothing = Hit(beyond_all, NO_HIT);
    Hit h1 = nothing;
    Hit h2 = nothing;
    Hit h3 = nothing;
    // Loops in the place of conditions: a software rasteriser skips those that no lane enters.
    for (bool in_memory = count > held; in_memory; in_memory = false) {
        sort_list(line, count);
    }
    Hit h0 = load_hit(line, 0u);
    for (bool more = count > 1u; more; more = false) {
        h1 = load_hit(line, 1u);
    }
    for (bool more = count > 2u; more; more = false) {
        h2 = load_hit(line, 2u);
    }
    for (bool more = count > 3u; more; more = false) {
        h3 = load_hit(line, 3u);
    }
    if (count <= held) {
        order(h0, h1);
        order(h2, h3);
        order(h0, h2);
        order(h1, h3);
        order(h1, h2);
        order_coincident(h0, h1);
        order_coincident(h0, h2);
        order_coincident(h0, h3);
        order_coincident(h1, h2);
        order_coincident(h1, h3);
        order_coincident(h2, h3);
    }
#ifdef SKY
    receive_sky(line, h0, false);
#endif
    for (uint k = 1u; k < count; ++k) {
        for (bool open = face_each_other(h0, h1); open; open = false) {
            exchange(line, h0, h1);
        }
        h0 = h1;
        h1 = h2;
        h2 = h3;
        h3 = nothing;
        for (bool more = k + held - 1u < count; more; more = false) {
            h3 = load_hit(line, k + held - 1u);
        }
    }
#ifdef SKY
    receive_sky(line, h0, true);
#endif
}

void main() {
    bool overflowed = counters.layers > layer_capacity();
    if (gl_GlobalInvocationID.x == 0u) {
        counters.overflowed = overflowed ? 1u : 0u;
        if (overflowed) {
            counters.wanted = max(counters.wanted, counters.layers);
            counters.overflow_mask |= 1u << slot;
        }
    }
    uint row = gl_GlobalInvocationID.x / columns;
    uint column = gl_GlobalInvocationID.x - row * columns;
    row = row_stride * row + row_phase;
    if (row >= rows || overflowed) {
        return;
    }
    uvec2 at = uvec2(first_column + column, first_row + row);
    Line line;
    line.pixel = at.y * bundle.resolution.x + at.x;
    uint count = layer_counts[line.pixel];
    if (count == 0u) {
        return;
    }
    line.point = window_point(at);
    line.pixel_area = bundle.weights.z * bundle.weights.z * float(row_stride);
    transfer(line, count);
}
