// SPDX-License-Identifier: Apache-2.0
// Rays of glossy pixels, one strategy more beside the bundles (ch. 6.2): a direction drawn from the pixel's own narrow lobe.
// LAND: what they bring; without it they are made.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "density.glsl"
#ifdef SKY
#include "sky_openings.glsl"
#endif
#include "scene_geometry.glsl"
#include "sending_gloss.glsl"
#include "sides.glsl"
#include "facets.glsl"
#include "octahedral.glsl"
#include "luminance.glsl"
#include "pixel_gloss.glsl"
#include "lobe_sampling.glsl"
#include "random_hash.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
#define SPECULAR_GROUPS_ACCESS readonly
#include "specular_groups.glsl"
#include "gloss_ray.glsl"
#ifdef CONTINUED
#include "continued.glsl"
#endif
#ifdef LAND
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;
#include "radiance_slope.glsl"
layout(std430, binding = BINDING_RADIANCE) readonly buffer RadianceBuffer { vec4 radiance[]; };
layout(std430, binding = BINDING_COUNTERS) readonly buffer CounterBuffer { Counters counters; };
layout(std430, binding = BINDING_PIXEL_GLOSS) buffer PixelGlossBuffer { vec4 pixel_gloss[]; };
layout(std430, binding = BINDING_PIXEL_SCATTER) buffer PixelScatterBuffer { float pixel_scatter[]; };
uniform bool layered;    // the running bundle is; it may have had no room
uniform bool first_look; // no sample: the pixels are new, and show what the patches know
uniform float look_weight;
uniform float ray_share; // rays of a pixel for each sample, in the mean
uniform vec4 slab;       // xyz: middle of the scene; w: depth of a parallel bundle's window, m
#else
uniform uint ray_number;  // since the pixels were made
uniform uint ray_seed;
#endif

struct Start {
    vec3 position;
    vec3 normal;
    vec3 geometric;
    vec3 w_out;
    vec3 albedo;
    vec4 at_out;
    Brdf brdf;
    vec2 lobes;
    uint facet;
    uint patch_id;
};

bool load_start(uint index, out Start x) {
    uvec4 p = texelFetch(pixel_texels, int(2u * index));
    uvec4 q = texelFetch(pixel_texels, int(2u * index + 1u));
    bool drawn = index < view.size.x * view.size.y && p.w != NO_PATCH && (q.w & PIXEL_GLOSSY) != 0u;
#ifdef MIRRORS
    drawn = drawn && (q.w & PIXEL_CONTINUED) == 0u;
#endif
    if (!drawn) {
        return false;
    }
    x.facet = q.w & PIXEL_FACET_MASK;
    x.patch_id = patch_of_side(p.w);
    // The surface point itself: the stored one is kept away from creases.
    uvec3 t = triangle_of(p.w).xyz;
    vec2 v = unpackUnorm2x16(q.z);
    x.position = world_position(t.x) * (1.0 - v.x - v.y) + world_position(t.y) * v.x + world_position(t.z) * v.y;
    x.normal = vector_from_octahedral(unpackSnorm2x16(q.x));
    x.geometric = facet_plane(x.facet).xyz;
    x.geometric = (q.w & PIXEL_BACK) != 0u ? -x.geometric : x.geometric;
#ifdef CONTINUED
    x.w_out = continued_towards(index);
#else
    x.w_out = normalize(view.eye.xyz - x.position);
#endif
    float cos_out = dot(x.normal, x.w_out);
    x.albedo = unpack_albedo(q.y);
    x.brdf = pixel_brdf(reflectance_record(facet_material(x.facet), q.y), x.albedo, cos_out, x.at_out);
    x.lobes = drawn_lobes(x.brdf);
    return cos_out > 0.0 && x.lobes != vec2(0.0);
}

#ifndef LAND
/// An additive recurrence (Roberts 2018), shifted for each pixel.
vec2 ray_numbers(uint index) {
    return fract(random_numbers_of(index, ray_seed).xy +
                 vec2(uvec2(ray_number * 3242174889u, ray_number * 2447445414u) >> 8u) * (1.0 / 16777216.0));
}

void main() {
    uint i = linear_index();
    if (i >= ray_count) {
        return;
    }
    uint index = pixel_of_ray(i);
    Start x;
    gloss_rays[i].facet = NO_HIT;
    if (!load_start(index, x)) {
        return;
    }
    vec3 w_in = drawn_direction(x.lobes, x.normal, x.w_out, ray_numbers(index));
    gloss_rays[i] = GlossRay(x.position, x.facet, w_in, NO_HIT);
}
#else
/// Radiance that a ray brings, and 1/d(omega) of bundles there, sr.
vec3 arriving(GlossRay ray, Start x, out float inverse_density) {
    float densities = bundle.densities.x;
    if (ray.surface == NO_HIT) {
        densities += bundle.densities.y * max(0.5 * slab.w + dot(slab.xyz - x.position, ray.direction), 0.0);
#ifdef SKY
        densities += opening_density(x.position, ray.direction, 1e12);
#endif
        inverse_density = 1.0 / max(densities, 1e-30);
#ifdef MEDIUM
        return ray.origin * left_by_air_from_sky(x.position, ray.direction);
#endif
        return ray.origin;
    }
    inverse_density = 0.0;
    Facet facet = load_facet(ray.surface >> 1);
    float along = dot(facet.plane.xyz, ray.direction);
    float r = max((facet.plane.w - dot(facet.plane.xyz, x.position)) / (abs(along) > 1e-7 ? along : 1e-7), 0.0);
    vec3 point = x.position + r * ray.direction;
    vec3 weights;
    uint y = patch_of_surface(2u * triangle_at(facet, point, weights) + (ray.surface & 1u));
    if (y == NO_PATCH) {
        return vec3(0.0);
    }
    vec4 l = radiance[y] + vec4(rise(slope_of(y), clamp(weights, 0.0, 1.0)), 0.0);
    float beside = 0.0;
#ifdef SKY
    beside = density_beside(x.patch_id, x.position, y, ray.direction, r);
#endif
    inverse_density = cosine_over_density(r, abs(along), l.w, beside);
    RARELY(is_glossy(y)) {
        vec3 normal = patch_plane(y).xyz;
        vec3 middle = centroid_of(triangle_of_patch(y), 0u);
        l.rgb += difference_radiance(sending_gloss(y, normal, middle, point), normal, above(-ray.direction, normal));
    }
#ifdef MEDIUM
    l.rgb *= left_by_air(r);
#endif
    return l.rgb;
}

void main() {
    uint i = linear_index();
    if (i >= ray_count || (layered && !first_look && counters.layers > bundle.resolution.z)) {
        return;
    }
    GlossRay ray = gloss_rays[i];
    uint index = pixel_of_ray(i);
    Start x;
    if (ray.facet == NO_HIT || !load_start(index, x)) {
        return;
    }
    float inverse_density;
    vec3 light = arriving(ray, x, inverse_density);
    float cos_in = dot(x.normal, ray.direction);
    light = cos_in > 0.0 && dot(x.geometric, ray.direction) > 0.0 ? light : vec3(0.0);
    vec4 at_in = brdf_at(x.brdf, cos_in);
    vec3 value = brdf_value(x.brdf, x.normal, ray.direction, x.w_out, at_in.z * x.at_out.z);
    float drawn = ray_share * drawn_density(x.lobes, x.normal, ray.direction, x.w_out);
    // One over all densities together: bundles find a direction, too.
    float over = inverse_density < 1e29 ? inverse_density / (1.0 + drawn * inverse_density) : 1.0 / max(drawn, 1e-30);
    vec3 reflected = light * value * (cos_in * over);
    // By rays alone, which need no sample of a bundle.
    Brdf part = drawn_part(x.brdf, x.lobes);
    float own = max(drawn_density(x.lobes, x.normal, ray.direction, x.w_out), 1e-30);
    vec3 by_rays = light * brdf_value(part, x.normal, ray.direction, x.w_out, 0.0) * (cos_in / own);
    if (!(dot(abs(reflected) + abs(by_rays), vec3(1.0)) < 1e30)) {
        return;
    }
    float weight = first_look ? look_weight : bundle.weights.y;
    pixel_gloss[view.size.x * view.size.y + index] += weight * vec4(by_rays, 1.0);
    if (first_look) {
        return;
    }
    pixel_gloss[index].rgb += weight * reflected;
    uvec2 at = uvec2(index % view.size.x, index / view.size.x);
    if ((at.x & 3u) == 1u && (at.y & 3u) == 1u) {
        uint probe = (at.y >> 2) * view.size.z + (at.x >> 2);
        pixel_scatter[SCATTER_SUMS * probe + SCATTER_OF_RAY] +=
            luminance(reflected / max(x.albedo * brdf_inverse_pi, 1e-4));
    }
}
#endif
