// SPDX-License-Identifier: Apache-2.0
// Perspective bundle to patches (ch. 5.1.2, eq. 5.5, with the combined density of ch. 6.3).
// For every hemicube pixel p that sees patch i from the shooter y:
//   irradiance_i += L(y) (1/A_i) r^2 domega_p cos_y/d,   since the pixel's footprint has cos_x dA = r^2 domega_p.
// A Lambert shooter has one radiance for all pixels: the sum is a scalar, multiplied by L in the update.
// In a special phase (COLOURED) it is multiplied here, so that the signed sums of several bundles add up.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "accumulator.glsl"
#include "density.glsl"
#include "scene_geometry.glsl"
#include "hemicube.glsl"
#ifdef THIN_WALLS
#include "crease.glsl"
#endif
layout(binding = UNIT_SURFACE_IDS) uniform usampler2D surface_ids;
layout(binding = UNIT_DEPTHS) uniform sampler2D depths;
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;
uniform uint first_column;  // the rectangle of the stacked picture that is transferred
uniform uint first_row;
uniform uint run_columns;   // runs of 8 pixels a row
uniform uint rows;
uniform uint last_column;   // one past the end
uniform uint row_stride;    // rows are sampled: every row_stride-th from row_phase on
uniform uint row_phase;
uniform uint patch_base;    // patches and vertices of the place that was drawn
uniform uint vertex_base;

const uint run_length = 8u;

/// What the pixels of a run share.
struct Run {
    uint surface;
    uint patch_id;  // NO_PATCH: nothing receives
    float factor;   // 1/A_i, sign and weight
    uint creases;
};

Run load_run(uint surface) {
    Run run;
    run.surface = surface;
    run.patch_id = surface == NO_HIT ? NO_PATCH : patch_of_surface(surface);
    uint index = patch_base + (run.patch_id == NO_PATCH ? 0u : run.patch_id);
    vec4 plane = patch_plane(index);
    // A shooter in the receiver's own plane sends it nothing; only rounding could say otherwise, and it
    // would leak through a wall without thickness.
    bool in_plane = dot(plane.xyz, bundle.origin.xyz) - plane.w <= bundle.sky.w;
    run.patch_id = in_plane ? NO_PATCH : run.patch_id;
    run.factor = patch_attributes(index).y * bundle.weights.x;
#ifdef THIN_WALLS
    run.creases = surface == NO_HIT ? 0u : crease_flags(surface >> 1);
#else
    run.creases = 0u;
#endif
    return run;
}

/// Share of a pixel's light that counts: 0 too close to a crease, else a factor that makes up for that.
float crease_factor(Run run, vec3 d, float inverse_length, float r) {
#ifdef THIN_WALLS
    if (run.creases == 0u) {
        return 1.0;
    }
    vec3 direction = d.x * bundle.axis_x.xyz + d.y * bundle.axis_y.xyz + d.z * bundle.axis_z.xyz;
    float pixel_width = 2.0 * inverse_length * r / float(bundle.resolution.x);
    return near_crease(run.surface >> 1, run.creases, vertex_base, bundle.origin.xyz, direction,
                       snap_distance * pixel_width)
               ? 0.0
               : crease_compensation(run.surface >> 1, run.creases, vertex_base, direction * inverse_length,
                                     pixel_width);
#else
    return 1.0;
#endif
}

void deposit(Run run, float sum) {
    if (run.patch_id == NO_PATCH) {
        return;
    }
#ifdef COLOURED
    vec3 irradiance = sum * run.factor * texelFetch(radiance_texels, int(bundle.resolution.z)).rgb;
    accumulate(run.patch_id, 0u, irradiance.r);
    accumulate(run.patch_id, 1u, irradiance.g);
    accumulate(run.patch_id, 2u, irradiance.b);
#else
    accumulate(run.patch_id, 0u, sum * run.factor);
#endif
}

void main() {
    if (gl_GlobalInvocationID.x == 0u) {
        counters.shooter_radiance = texelFetch(radiance_texels, int(bundle.resolution.z));
        counters.overflowed = 0u;
    }
    // Neighbouring invocations take neighbouring rows: their runs end at nearly the same places.
    uint block = gl_GlobalInvocationID.x >> 3;
    uint row_block = block / run_columns;
    uint row = row_stride * (row_block * 8u + (gl_GlobalInvocationID.x & 7u)) + row_phase;
    if (row >= rows) {
        return;
    }
    uint x = first_column + (block - row_block * run_columns) * run_length;
    int end = int(min(x + run_length, last_column));
    ivec2 texel = ivec2(x, first_row + row);
    float n = float(bundle.resolution.x);
    float pixel_area = 4.0 * float(row_stride) / (n * n);  // at unit focal distance
    int face;
    vec3 d = hemicube_direction(vec2(texel) + 0.5, n, face);
    vec3 d_step = hemicube_face(face)[0] * (2.0 / n);
    float escaped = 0.0;
    uint surface = texelFetch(surface_ids, texel, 0).r;
    while (texel.x < end) {
        Run run = load_run(surface);
        float sum = 0.0;
        float missed = 0.0;
        // All pixels of this run.
        do {
            float inverse_length = inversesqrt(dot(d, d));
            float inverse_square = inverse_length * inverse_length;
            missed += d.z * inverse_square * inverse_square;  // cos_y domega / pixel area
            // Reversed infinite depth: depth = near / (distance along the face's axis).
            float r = bundle.origin.w / (texelFetch(depths, texel, 0).r * inverse_length);
            sum += r * r * inverse_length * inverse_square * crease_factor(run, d, inverse_length, r) *
                   cosine_over_density(r, d.z * inverse_length, bundle.densities.w);
            ++texel.x;
            d += d_step;
            surface = texel.x < end ? texelFetch(surface_ids, texel, 0).r : NO_HIT;
        } while (texel.x < end && surface == run.surface);
        deposit(run, sum * pixel_area);
        escaped += run.patch_id == NO_PATCH ? missed : 0.0;
    }
    if (escaped > 0.0) {
        atomicAdd(counters.escaped, uint(escaped * pixel_area * 341782637.8 + 0.5));  // 2^30 / pi
    }
}
