// SPDX-License-Identifier: Apache-2.0
// Bundle from a point of an opening to the sky, to patches: for every pixel p that sees patch i, and what lies the other
// way,
//   irradiance_i += L (1/A_i) r^2 domega_p / d,   since the pixel's footprint has cos_x dA = r^2 domega_p.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "accumulator.glsl"
#include "density.glsl"
#include "scene_geometry.glsl"
#include "facets.glsl"
#include "hemicube_runs.glsl"
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;
#include "radiance_slope.glsl"
#include "opening_light.glsl"

void deposit(Run run, vec3 sum) {
    if (run.patch_id == NO_PATCH || sum == vec3(0.0)) {
        return;
    }
    sum *= patch_attributes(patch_base + run.patch_id).y;  // 1/A_i
    accumulate(run.patch_id, 0u, sum.r);
    accumulate(run.patch_id, 1u, sum.g);
    accumulate(run.patch_id, 2u, sum.b);
}

void main() {
    if (linear_index() == 0u) {
        counters.overflowed = 0u;
    }
    ivec2 texel;
    int end;
    if (!take_pixels(texel, end)) {
        return;
    }
    float n = float(bundle.resolution.x);
    float pixel_area = 4.0 * float(row_stride) / (n * n);  // at unit focal distance
    int face;
    mat3 world_from_bundle = mat3(bundle.axis_x.xyz, bundle.axis_y.xyz, bundle.axis_z.xyz);
    vec3 d = world_from_bundle * hemicube_direction(sample_point(texel), n, face);
    vec3 d_step = world_from_bundle * hemicube_face(face)[0] * (2.0 / n);
    float farthest = bundle.origin.w / NEAR_SHARE;  // the scene's diameter
    uint surface = texelFetch(surface_ids, texel, 0).r;
    while (texel.x < end) {
        Run run = start_run(surface, d, d_step);
        vec3 sum = vec3(0.0);
        bool same;
        // All pixels of this run.
        do {
            float inverse_length = inversesqrt(dot(d, d));
            if (run.patch_id != NO_PATCH) {
                float r = min(1.0 / (max(run.reciprocal, 1e-20) * inverse_length), farthest);
                vec3 inwards = d * inverse_length;
                float footprint = r * r * inverse_length * inverse_length * inverse_length *
                                  crease_factor(run, d, inverse_length, r);
                float found;
                sum += footprint *
                       light_through(texel, run.patch_id, bundle.origin.xyz + r * inwards, -inwards, r, found);
            }
            ++texel.x;
            d += d_step;
            run.reciprocal += run.reciprocal_step;
            run.weights += run.weights_step;
            surface = texel.x < end ? texelFetch(surface_ids, texel, 0).r : NO_HIT;
            same = surface == run.surface && all(greaterThanEqual(run.weights, vec3(0.0)));
        } while (texel.x < end && same);
        deposit(run, sum * pixel_area);
    }
}
