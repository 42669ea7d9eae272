// SPDX-License-Identifier: Apache-2.0
// A hemicube's pixels, row by row, as runs that see one triangle. The including shader has what facets.glsl,
// scene_geometry.glsl and linear_index.glsl declare.
#include "hemicube.glsl"
#ifdef THIN_WALLS
#include "crease.glsl"
#endif
layout(binding = UNIT_SURFACE_IDS) uniform usampler2D surface_ids;
uniform uint first_column;  // the rectangle of the stacked picture that is transferred
uniform uint first_row;
uniform uint run_columns;   // runs of 8 pixels a row
uniform uint rows;
uniform uint last_column;   // one past the end
uniform uint row_stride;    // rows are sampled: every row_stride-th from row_phase on
uniform uint row_phase;
uniform uint patch_base;    // patches, facets and vertices of the place that was drawn
uniform uint facet_base;
uniform uint vertex_base;

const uint run_length = 8u;

/// Consecutive pixels of a row that see one triangle. D is the direction through a pixel, in world
/// space, with 1 along the face's axis; it is linear along the row, and so are the reciprocal of the
/// distance in units of D and the triangle's barycentric weights divided by that distance.
struct Run {
    uint surface;
    uint triangle;
    uint patch_id;  // NO_PATCH: nothing receives
    float reciprocal, reciprocal_step;
    vec3 weights, weights_step;
    uint creases;
};

Run start_run(uint surface, vec3 d, vec3 d_step) {
    Run run;
    run.surface = surface;
    run.triangle = 0u;
    run.patch_id = NO_PATCH;
    run.reciprocal = 1.0;
    run.reciprocal_step = 0.0;
    run.weights = vec3(1.0);
    run.weights_step = vec3(0.0);
    run.creases = 0u;
#ifdef DOUBLE_SIDED
    bool blocked = surface == NO_HIT;
#else
    bool blocked = surface == NO_HIT || (surface & 1u) != 0u;
#endif
    Facet facet = load_facet(facet_base + (blocked ? 0u : surface >> 1));
    vec3 o = bundle.origin.xyz;
    float height = facet.plane.w - dot(facet.plane.xyz, o);
    // A shooter in the receiver's own plane sends it nothing; only rounding could say otherwise, and it
    // would leak through a wall without thickness.
    if (blocked || ((surface & 1u) != 0u ? height : -height) <= bundle.origin.w) {
        return run;
    }
    vec3 row = facet.plane.xyz / height;
    vec3 row1 = facet.weight1.xyz + row * dot(facet.weight1, vec4(o, 1.0));
    vec3 row2 = facet.weight2.xyz + row * dot(facet.weight2, vec4(o, 1.0));
    vec3 row0 = row - row1 - row2;
    run.reciprocal = dot(row, d);
    run.reciprocal_step = dot(row, d_step);
    run.weights = vec3(dot(row0, d), dot(row1, d), dot(row2, d));
    run.weights_step = vec3(dot(row0, d_step), dot(row1, d_step), dot(row2, d_step));
    run.triangle = triangle_at(facet.root, run.weights, run.weights_step);
    run.patch_id = patch_of_surface(2u * run.triangle + (surface & 1u));
#ifdef THIN_WALLS
    run.creases = crease_flags(run.triangle);
#endif
    return run;
}

/// Share of a pixel's light that counts: 0 too close to a crease, else a factor that makes up for that.
float crease_factor(Run run, vec3 d, float inverse_length, float r) {
#ifdef THIN_WALLS
    if (run.creases == 0u) {
        return 1.0;
    }
    float pixel_width = 2.0 * inverse_length * r / float(bundle.resolution.x);
    return near_crease(run.triangle, run.creases, vertex_base, bundle.origin.xyz, d, snap_distance * pixel_width)
               ? 0.0
               : crease_compensation(run.triangle, run.creases, vertex_base, d * inverse_length, pixel_width);
#else
    return 1.0;
#endif
}

/// The pixels of this invocation: [texel.x, end) of a row. False where it has none. Neighbouring invocations take
/// neighbouring rows: their runs end at nearly the same places.
bool take_pixels(out ivec2 texel, out int end) {
    uint block = linear_index() >> 3;
    uint row_block = block / run_columns;
    uint row = row_stride * (row_block * 8u + (linear_index() & 7u)) + row_phase;
    uint x = first_column + (block - row_block * run_columns) * run_length;
    end = int(min(x + run_length, last_column));
    texel = ivec2(x, first_row + row);
    return row < rows;
}
