// SPDX-License-Identifier: Apache-2.0
// Perspective bundle to patches (ch. 5.1.2, eq. 5.5, with the combined density of ch. 6.3).
// For every hemicube pixel p that sees patch i from the shooter y:
//   irradiance_i += L(y) (1/A_i) r^2 domega_p cos_y/d,   since the pixel's footprint has cos_x dA = r^2 domega_p.
// A Lambert shooter has one radiance for all pixels: the sum is a scalar, multiplied by L in the update.
// In a special phase (COLOURED) it is multiplied here, so that the signed sums of several bundles add up.
// The radiance of a glossy shooter (SHOOTER_GLOSSY) differs from pixel to pixel.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "luminance.glsl"
#include "accumulator.glsl"
#include "rarely.glsl"
#include "density.glsl"
#ifdef SKY
#include "sky_openings.glsl"
#endif
#include "scene_geometry.glsl"
#ifdef SHOOTER_GLOSSY
#include "sending_gloss.glsl"
#endif
#include "facets.glsl"
#include "hemicube_runs.glsl"
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;
#include "radiance_slope.glsl"
/// What is summed over pixels: form factors, or irradiance where the shooter is glossy.
#ifdef SHOOTER_GLOSSY
#define Sum vec3
#define COLOURED
#else
#define Sum float
#endif

void deposit(Run run, Sum sum) {
    if (run.patch_id == NO_PATCH) {
        return;
    }
    sum *= patch_attributes(patch_base + run.patch_id).y * bundle.weights.x;  // 1/A_i, sign and weight
#ifdef COLOURED
#ifdef SHOOTER_GLOSSY
    vec3 irradiance = sum;
#else
    vec3 irradiance = sum * (radiance_at(bundle.resolution.z, bundle.slopes.xyz).rgb - bundle.constant.rgb);
#endif
    accumulate(run.patch_id, 0u, irradiance.r);
    accumulate(run.patch_id, 1u, irradiance.g);
    accumulate(run.patch_id, 2u, irradiance.b);
#else
    accumulate(run.patch_id, 0u, sum);
#endif
}

void main() {
    if (linear_index() == 0u) {
#ifdef SHOOTER_GLOSSY
        vec4 sent = texelFetch(radiance_texels, int(bundle.resolution.z));  // what `missed` is a share of
#else
        vec4 sent = radiance_at(bundle.resolution.z, bundle.slopes.xyz);
#endif
        counters.shooter_radiance = vec4(sent.rgb - bundle.constant.rgb, sent.w);
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
    vec3 in_bundle = hemicube_direction(sample_point(texel), n, face);
    vec3 d = world_from_bundle * in_bundle;
    vec3 d_step = world_from_bundle * hemicube_face(face)[0] * (2.0 / n);
    float d_z = in_bundle.z;
    float d_z_step = hemicube_face(face)[0].z * (2.0 / n);
    float farthest = bundle.origin.w / NEAR_SHARE;  // the scene's diameter
    float escaped = 0.0;
#ifdef SHOOTER_GLOSSY
    pixel_area *= face_weight(face);
    vec3 normal = shooter_normal();
    Gloss shooter = shooter_gloss(vertex_base);
    vec3 main_part = radiance_at(bundle.resolution.z, bundle.slopes.xyz).rgb;
    float inverse_luminance = 1.0 / max(luminance(texelFetch(radiance_texels, int(bundle.resolution.z)).rgb), 1e-20);
#endif
    uint surface = texelFetch(surface_ids, texel, 0).r;
    while (texel.x < end) {
        Run run = start_run(surface, d, d_step);
#if defined(SKY) && !defined(SHOOTER_GLOSSY)
        bool opens = openings_carry(bundle.resolution.z, run.patch_id);
#endif
        Sum sum = Sum(0.0);
        float missed = 0.0;
        bool same;
        // All pixels of this run.
        do {
            float inverse_length = inversesqrt(dot(d, d));
            float inverse_square = inverse_length * inverse_length;
            float cosine = d_z * inverse_square * inverse_square;  // cos_y domega / pixel area
            float r = min(1.0 / (max(run.reciprocal, 1e-20) * inverse_length), farthest);
            float beside = 0.0;
#if defined(SKY) && !defined(SHOOTER_GLOSSY)
            RARELY(opens) {
                vec3 outwards = -inverse_length * d;
                beside = opening_density(bundle.origin.xyz - r * outwards, outwards, r);
            }
#endif
            float form_factor = r * r * inverse_length * inverse_square * crease_factor(run, d, inverse_length, r) *
                                cosine_over_density(r, d_z * inverse_length, bundle.densities.w, beside);
#ifdef MEDIUM
            form_factor *= left_by_air(r);
#endif
#ifdef SHOOTER_GLOSSY
            vec3 sent = main_part + difference_radiance(shooter, normal, above(d * inverse_length, normal));
            missed += cosine * luminance(sent) * inverse_luminance;
            sum += form_factor * (sent - bundle.constant.rgb);
#else
            missed += cosine;
            sum += form_factor;
#endif
            ++texel.x;
            d += d_step;
            d_z += d_z_step;
            run.reciprocal += run.reciprocal_step;
            run.weights += run.weights_step;
            surface = texel.x < end ? texelFetch(surface_ids, texel, 0).r : NO_HIT;
            same = surface == run.surface && all(greaterThanEqual(run.weights, vec3(0.0)));
        } while (texel.x < end && same);
        deposit(run, sum * pixel_area);
        escaped += run.patch_id == NO_PATCH ? missed : 0.0;
    }
    if (escaped != 0.0 && bundle.weights.y > 0.0) {  // not in special phases
        atomicAdd(counters.escaped, int(round(clamp(escaped * pixel_area, -64.0, 64.0) * 5340353.7)));  // 2^24 / pi
    }
}
