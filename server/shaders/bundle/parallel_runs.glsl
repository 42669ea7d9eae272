// SPDX-License-Identifier: Apache-2.0
// Exchange of radiance between what lies behind and ahead in a parallel bundle (ch. 4.3), summed over runs
// of pixels that stay on the same two patches:
//   irradiance_i += L(y) (pixel area / A_i) / d(omega)   (cos_x dA_x = pixel area).
// Lines that meet nothing on one side carry the sky's radiance to the other.
// The including shader declares uvec2 load_pair(ivec2 texel): surface behind, surface ahead, or NO_HIT. It defines
// AS_RASTERISED where that may return surfaces that the rasteriser has turned over (folded_over).
#include "accumulator.glsl"
#include "density.glsl"
#include "scene_geometry.glsl"
#include "facets.glsl"
#include "parallel.glsl"
#include "rarely.glsl"
#ifdef THIN_WALLS
#include "crease.glsl"
#endif
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;  // along the bundle
#include "radiance_slope.glsl"
uniform uint row_stride;   // rows are sampled: every row_stride-th from row_phase on
uniform uint row_phase;
uniform uint patch_base;   // patches, facets and vertices of the place that was drawn
uniform uint facet_base;
uniform uint vertex_base;

uvec2 load_pair(ivec2 texel);

const uint run_length = uint(RUN_LENGTH);  // pixels of a row that one invocation sums

/// Consecutive pixels of a row that see one patch on one side. Depth and the triangle's barycentric
/// weights are linear along the row.
struct Run {
    uint surface;
    uint patch_id;  // NO_PATCH: nothing is sent or received
    float depth, depth_step;
    float cosine;   // between normal and axis
    vec3 weights, weights_step;
    vec4 radiance;  // w = p_j/A_j
    vec3 radiance_step;
    vec3 received;  // sum of L / d(omega)
#ifdef THIN_WALLS
    uint triangle;
    uint creases;
    float compensation;
#endif
};

/// far: whether the side that looks towards +z is wanted. pixel_step: from pixel to pixel along the row.
Run start_run(uint surface, bool far, vec3 point, vec3 pixel_step) {
    Run run;
    run.surface = surface;
    run.patch_id = NO_PATCH;
    run.depth = 0.0;
    run.depth_step = 0.0;
    run.cosine = 1.0;
    run.weights = vec3(1.0);
    run.weights_step = vec3(0.0);
    run.radiance = vec4(0.0);
    run.radiance_step = vec3(0.0);
    run.received = vec3(0.0);
#ifdef THIN_WALLS
    run.triangle = 0u;
    run.creases = 0u;
    run.compensation = 1.0;
#endif
#if defined(DOUBLE_SIDED) || defined(CONSTANT_RADIANCE)
    bool blocked = surface == NO_HIT;
#else
    bool blocked = surface == NO_HIT || faces_far(surface) != far;
#endif
    if (blocked) {
        return run;
    }
    vec3 axis = bundle.axis_z.xyz;
    Facet facet = load_facet(facet_base + facet_of(surface));
#ifdef AS_RASTERISED
    if (folded_over(surface, facet.plane)) {
        return run;
    }
#endif
    run.depth = plane_depth(facet.plane, point);
    run.depth_step = plane_depth(facet.plane, point + pixel_step) - run.depth;
    run.cosine = abs(dot(facet.plane.xyz, axis));
    vec3 hit_step = pixel_step + run.depth_step * axis;
    vec4 hit = vec4(point + run.depth * axis, 1.0);
    float w1 = dot(facet.weight1, hit);
    float w2 = dot(facet.weight2, hit);
    float s1 = dot(facet.weight1.xyz, hit_step);
    float s2 = dot(facet.weight2.xyz, hit_step);
    run.weights = vec3(1.0 - w1 - w2, w1, w2);
    run.weights_step = vec3(-s1 - s2, s1, s2);
    uint triangle = triangle_at(facet.root, run.weights, run.weights_step);
    run.patch_id = patch_of_surface(2u * triangle + side_of_surface(surface, far));
    if (run.patch_id != NO_PATCH) {
        run.radiance = radiance_at(run.patch_id, run.weights);
        run.radiance_step = rise(slope_of(run.patch_id), run.weights_step);
    }
#ifdef CONSTANT_RADIANCE  // what sends nothing lacks the constant term
    run.radiance.rgb -= bundle.constant.rgb;
#endif
#ifdef THIN_WALLS
    run.triangle = triangle;
    run.creases = crease_flags(triangle);
    run.compensation = run.creases == 0u ? 1.0
                                         : crease_compensation(triangle, run.creases, vertex_base, axis,
                                                               bundle.weights.z);
#endif
    return run;
}

/// Whether the next pixel of the row belongs to the run; goes there.
bool go_on(inout Run run, uint surface) {
    run.depth += run.depth_step;
    run.weights += run.weights_step;
    return surface == run.surface && all(greaterThanEqual(run.weights, vec3(0.0)));
}

/// 0 where the line passes too close to a crease of the run's triangle, else the factor that makes up
/// for it.
float crease_factor(Run run, vec3 point) {
#ifdef THIN_WALLS
    return run.creases != 0u && near_crease(run.triangle, run.creases, vertex_base, point, bundle.axis_z.xyz,
                                            snap_distance * bundle.weights.z)
               ? 0.0
               : run.compensation;
#else
    return 1.0;
#endif
}

void deposit(Run run, float pixel_area) {
    if (run.patch_id == NO_PATCH || run.received == vec3(0.0)) {
        return;
    }
    float sign = is_turned_over(run.surface) ? -1.0 : 1.0;
    vec3 value = run.received * (sign * pixel_area * patch_attributes(patch_base + run.patch_id).y * bundle.weights.x);
    accumulate(run.patch_id, 0u, value.r);
    accumulate(run.patch_id, 1u, value.g);
    accumulate(run.patch_id, 2u, value.b);
}

#ifdef SKY
/// point: of the line, in the window's plane; depth: of the receiver.
float sky_weight(vec3 point, float depth, bool far) {
    float density = sky_density(point + depth * bundle.axis_z.xyz, depth, far);
    return density > 0.0 ? 1.0 / density : 0.0;
}
#endif

struct Exchange {
    vec2 weights;  // sums of 1/d(omega) towards behind (x) and towards ahead (y)
    bool same_behind, same_ahead;  // whether the next pixel belongs to the same runs
#ifdef CONSTANT_RADIANCE
    float dark;  // the same sum where the sides coincide: nothing comes from there, which lacks the constant
#endif
};

/// Follows both sides over as many pixels as both stay on their patches.
Exchange follow(inout Run behind, inout Run ahead, inout ivec2 texel, inout vec3 point, vec3 pixel_step, int end,
                inout uvec2 surfaces) {
    Exchange e;
    e.weights = vec2(0.0);
#ifdef CONSTANT_RADIANCE
    e.dark = 0.0;
#endif
#ifdef SKY
    bool opens_to_behind = openings_carry(ahead.patch_id, behind.patch_id);
    bool opens_to_ahead = openings_carry(behind.patch_id, ahead.patch_id);
#endif
    do {
        float r = ahead.depth - behind.depth;
        vec2 w = vec2(cosine_over_density(r, ahead.cosine, ahead.radiance.w),
                      cosine_over_density(r, behind.cosine, behind.radiance.w));
#ifdef SKY
        RARELY(opens_to_behind) {
            vec3 towards = bundle.axis_z.xyz;
            float beside = opening_density(point + behind.depth * towards, towards, r);
            w.x = cosine_over_density(r, ahead.cosine, ahead.radiance.w, beside);
        }
        RARELY(opens_to_ahead) {
            vec3 towards = -bundle.axis_z.xyz;
            float beside = opening_density(point - ahead.depth * towards, towards, r);
            w.y = cosine_over_density(r, behind.cosine, behind.radiance.w, beside);
        }
#endif
        // Closer surfaces coincide; only rounding could put the plane between them.
#ifdef CONSTANT_RADIANCE
        bool met = behind.surface != NO_HIT && ahead.surface != NO_HIT;
        e.dark += met && r <= bundle.sky.w ? crease_factor(behind, point) * crease_factor(ahead, point) : 0.0;
#endif
        w = r > bundle.sky.w ? w : vec2(0.0);
#ifdef MEDIUM
        w = r > bundle.sky.w ? w * left_by_air(r) : w;
#endif
#ifdef SKY
        w.x = ahead.surface == NO_HIT ? sky_weight(point, behind.depth, true) : w.x;
        w.y = behind.surface == NO_HIT ? sky_weight(point, ahead.depth, false) : w.y;
#ifdef MEDIUM
        vec3 axis = bundle.axis_z.xyz;
        w.x *= ahead.surface == NO_HIT ? left_by_air_from_sky(point + behind.depth * axis, axis) : 1.0;
        w.y *= behind.surface == NO_HIT ? left_by_air_from_sky(point + ahead.depth * axis, -axis) : 1.0;
#endif
#endif
        e.weights += w * (crease_factor(behind, point) * crease_factor(ahead, point));
        ++texel.x;
        point += pixel_step;
        if (texel.x < end) {
            surfaces = load_pair(texel);
        }
        e.same_behind = go_on(behind, surfaces.x);
        e.same_ahead = go_on(ahead, surfaces.y);
    } while (texel.x < end && e.same_behind && e.same_ahead);
    return e;
}

/// Mean over the next pixels of the run, whose radiance becomes that of the pixel after them.
vec3 mean_radiance(inout Run run, int pixels) {
    vec3 mean = run.radiance.rgb + 0.5 * float(pixels - 1) * run.radiance_step;
    run.radiance.rgb += float(pixels) * run.radiance_step;
    return mean;
}

/// Transfers the pixels [texel.x, end) of a row.
void exchange_row(ivec2 texel, int end) {
    float pixel_area = bundle.weights.z * bundle.weights.z * float(row_stride);
    vec3 point = window_point(uvec2(texel));
    vec3 pixel_step = bundle.weights.z * bundle.axis_x.xyz;
    uvec2 surfaces = load_pair(texel);
    Run behind = start_run(surfaces.x, true, point, pixel_step);
    Run ahead = start_run(surfaces.y, false, point, pixel_step);
    while (texel.x < end) {
        int start = texel.x;
        Exchange e = follow(behind, ahead, texel, point, pixel_step, end, surfaces);
        vec3 from_ahead = mean_radiance(ahead, texel.x - start);
        vec3 from_behind = mean_radiance(behind, texel.x - start);
#ifdef SKY
        from_ahead = ahead.surface == NO_HIT ? sky_radiance(true) : from_ahead;
        from_behind = behind.surface == NO_HIT ? sky_radiance(false) : from_behind;
#endif
        behind.received += e.weights.x * from_ahead;
        ahead.received += e.weights.y * from_behind;
#ifdef CONSTANT_RADIANCE
        vec3 missing = bundle.constant.rgb * (bundle.densities.x > 0.0 ? e.dark / bundle.densities.x : 0.0);
        behind.received -= missing;
        ahead.received -= missing;
#endif
        RARELY(!e.same_behind && texel.x < end) {
            deposit(behind, pixel_area);
            behind = start_run(surfaces.x, true, point, pixel_step);
        }
        RARELY(!e.same_ahead && texel.x < end) {
            deposit(ahead, pixel_area);
            ahead = start_run(surfaces.y, false, point, pixel_step);
        }
    }
    deposit(behind, pixel_area);
    deposit(ahead, pixel_area);
}
