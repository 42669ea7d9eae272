// SPDX-License-Identifier: Apache-2.0
// Layered parallel bundle to patches (ch. 4.3, 4.3.1): consecutive, mutually facing surfaces exchange
// radiance both ways:  irradiance_i += L(y) (pixel area / A_i) / d(omega)   (cos_x dA_x = pixel area).
// Lines that meet nothing carry the sky's radiance.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "accumulator.glsl"
#include "density.glsl"
#include "scene_geometry.glsl"
#include "layers.glsl"
#ifdef THIN_WALLS
#include "crease.glsl"
#endif
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;
uniform uint first_column;
uniform uint first_row;
uniform uint columns;
uniform uint rows;
uniform uint row_stride;  // rows are sampled: every row_stride-th from row_phase on
uniform uint row_phase;
uniform uint patch_base;
uniform uint vertex_base;

void deposit(uint patch_id, vec3 irradiance) {
    vec3 value = irradiance * (patch_attributes(patch_base + patch_id).y * bundle.weights.x);
    accumulate(patch_id, 0u, value.r);
    accumulate(patch_id, 1u, value.g);
    accumulate(patch_id, 2u, value.b);
}

void exchange(uint a, uint b, float r, float pixel_area) {
    vec4 la = texelFetch(radiance_texels, int(a));
    vec4 lb = texelFetch(radiance_texels, int(b));
    float cos_a = abs(dot(patch_plane(patch_base + a).xyz, bundle.axis_z.xyz));
    float cos_b = abs(dot(patch_plane(patch_base + b).xyz, bundle.axis_z.xyz));
    // 1/d(omega) for x on a, y on b, and the other way round.
    deposit(a, lb.rgb * (pixel_area * cosine_over_density(r, cos_b, lb.w)));
    deposit(b, la.rgb * (pixel_area * cosine_over_density(r, cos_a, la.w)));
}

/// 0 where the line passes too close to a crease of the surface, else the factor that makes up for it.
float crease_factor(uint surface, vec3 line) {
#ifdef THIN_WALLS
    uint triangle = surface >> 1;
    uint flags = crease_flags(triangle);
    vec3 axis = bundle.axis_z.xyz;
    return near_crease(triangle, flags, vertex_base, line, axis, snap_distance * bundle.weights.z)
               ? 0.0
               : crease_compensation(triangle, flags, vertex_base, axis, bundle.weights.z);
#else
    return 1.0;
#endif
}

void main() {
    uint row = gl_GlobalInvocationID.x / columns;
    uint column = gl_GlobalInvocationID.x - row * columns;
    row = row_stride * row + row_phase;
    if (row >= rows || counters.nodes > uint(nodes.length())) {
        return;
    }
    uvec2 at = uvec2(first_column + column, first_row + row);
    uint node = heads[at.y * bundle.resolution.x + at.x];
    if (node == NO_NODE) {
        return;
    }
    vec2 window_point = (vec2(at) + 0.5) * bundle.weights.z;
    vec3 line = bundle.origin.xyz + window_point.x * bundle.axis_x.xyz + window_point.y * bundle.axis_y.xyz;
    float pixel_area = bundle.weights.z * bundle.weights.z * float(row_stride);
    uint surface = nodes[node].surface;
    float depth = nodes[node].depth;
#ifdef SKY
    vec3 sky_irradiance = bundle.densities.x > 0.0 ? bundle.sky.rgb * (pixel_area / bundle.densities.x) : vec3(0.0);
    uint first = patch_on_side(surface, false);
    if (first != NO_PATCH) {
        deposit(first, sky_irradiance);
    }
#endif
    for (node = nodes[node].next; node != NO_NODE; node = nodes[node].next) {
        uint next_surface = nodes[node].surface;
        float next_depth = nodes[node].depth;
        float r = next_depth - depth;
        uint a = patch_on_side(surface, true);
        uint b = patch_on_side(next_surface, false);
        if (r > bundle.sky.w && a != NO_PATCH && b != NO_PATCH) {
            exchange(a, b, r, pixel_area * crease_factor(surface, line) * crease_factor(next_surface, line));
        }
        surface = next_surface;
        depth = next_depth;
    }
#ifdef SKY
    uint last = patch_on_side(surface, true);
    if (last != NO_PATCH) {
        deposit(last, sky_irradiance);
    }
#endif
}
