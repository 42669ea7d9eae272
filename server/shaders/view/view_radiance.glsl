// SPDX-License-Identifier: Apache-2.0
// Radiance of a viewer's pixel: confidence-weighted blend of the object-space value and the pixel's own
// estimate, times the albedo at the angle of view, and the glossy part. Variant PATCHES_ONLY: the object-space value
// alone, as walkthroughs show it; vertices have all of its light.
#include "rarely.glsl"
#if defined(CONSTANT_RADIANCE) || defined(IES)
#include "facets.glsl"
#endif
#include "pixel_albedo.glsl"
#include "pixel_sum.glsl"
#include "zone_level.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
#include "view_place.glsl"
#if defined(MEDIUM) && !defined(CONTINUED)
#define AIR_BEFORE  // the ends of view rays know of all air on their way
#include "view_air.glsl"
#endif
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
layout(binding = UNIT_PIXEL_IRRADIANCE) uniform samplerBuffer pixel_irradiance_texels;
layout(binding = UNIT_PIXEL_KEPT) uniform samplerBuffer pixel_kept_texels;
layout(binding = UNIT_VERTEX_IRRADIANCE) uniform samplerBuffer vertex_irradiance_texels;
#ifdef GLOSSY
layout(binding = UNIT_PIXEL_GLOSS) uniform samplerBuffer pixel_gloss_texels;
#endif
#ifdef ENVIRONMENT
#include "environment.glsl"
#endif
#ifdef MIRRORS
#include "octahedral.glsl"
#include "continued.glsl"
#ifndef CONTINUED
layout(std430, binding = BINDING_CONTINUED_RADIANCE) readonly buffer ContinuedRadianceBuffer {
    vec4 continued_radiance[];
};
#endif
#endif
#ifdef FIRST_SHOT
layout(binding = UNIT_PIXEL_FIRST_SHOT) uniform samplerBuffer pixel_first_shot_texels;
#endif
#ifdef CAUSTICS
layout(binding = UNIT_VERTEX_CAUSTICS) uniform samplerBuffer vertex_caustics_texels;
#endif
#include "scene_geometry.glsl"
#include "mesh.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
uniform uint triangle_count;

const float inverse_pi = 0.31830988618;

PixelSurface load_pixel(uint index) {
    uvec4 a = texelFetch(pixel_texels, int(2u * index));
    uvec4 b = texelFetch(pixel_texels, int(2u * index + 1u));
    return PixelSurface(uintBitsToFloat(a.xyz), a.w, b.x, b.y, b.z, b.w);
}

/// What is known at the vertices, interpolated, on the side that is seen or on the other.
vec3 from_vertices(samplerBuffer values, PixelSurface p, bool behind) {
    uint triangle = p.side;
    uint side = behind ? 1u : 0u;
#ifdef DOUBLE_SIDED
    if (p.side >= triangle_count) {
        triangle = triangle_of_side(p.side);
        side = 1u - side;
    }
#endif
    uvec3 t = 2u * load_triangle(triangle).xyz + side;
    vec2 v = unpackUnorm2x16(p.barycentric);
    return texelFetch(values, int(t.x)).rgb * (1.0 - v.x - v.y) + texelFetch(values, int(t.y)).rgb * v.x +
           texelFetch(values, int(t.z)).rgb * v.y;
}

/// Irradiance of the object-space solution, radiance units.
vec3 object_space_irradiance(PixelSurface p, bool behind) {
    return from_vertices(vertex_irradiance_texels, p, behind);
}

/// What has come in at a pixel since the last change: its sum, with its weight.
vec4 own_sum(uint index, PixelSurface p) {
    vec4 own = texelFetch(pixel_irradiance_texels, int(index));
#ifdef CONSTANT_RADIANCE
    own.rgb += constant_share(p.normal, p.facet) * view.constant.rgb;
#endif
    own.w = pixel_weight(own, view.weights.x);
    return own;
}

/// A pixel's sum, with its weight: what has come in since the last change, and what is believed of what was kept over it.
vec4 shown_sum(uint index, PixelSurface p) {
    vec4 own = own_sum(index, p);
    vec4 kept = texelFetch(pixel_kept_texels, int(index));
    return kept.w > 0.0 ? own + believed_sum(patch_of_side(p.side), kept, own) : own;
}

#include "view_confidence.glsl"

/// Of what bundles bring alone.
vec3 bundled_irradiance(uint index, PixelSurface p) {
    vec4 sum = shown_sum(index, p);
    return mix(object_space_irradiance(p, false), pixel_mean(sum, 0.0), confidence(index, p.side, sum.w));
}

vec3 blended_irradiance(uint index, PixelSurface p) {
#ifdef PATCHES_ONLY
    return object_space_irradiance(p, false);
#endif
    vec3 blended = bundled_irradiance(index, p);
#ifdef FIRST_SHOT
    blended += texelFetch(pixel_first_shot_texels, int(index)).rgb;
#endif
#ifdef CAUSTICS
    blended = max(blended + from_vertices(vertex_caustics_texels, p, false), 0.0);
#endif
    return blended;
}

vec3 pixel_albedo(PixelSurface p) { return unpack_albedo(p.albedo); }

/// Radiance of what a pixel sees beyond the scene.
vec3 background(uint index) {
    vec3 sum = view.sky.rgb;
#ifdef ENVIRONMENT
#ifdef CONTINUED
    vec3 direction = -continued_towards(index);
#else
    uint row = index / view.size.x;
    uvec2 at = uvec2(index - row * view.size.x, row);
    vec3 direction = view_direction(at, place_in_pixel(at));
#endif
    sum += environment_radiance(normalize(direction)) * view.sky.w;
#endif
    return sum;
}

#if defined(MIRRORS) && !defined(CONTINUED)
/// What a mirror or glass shows: the light at the ends of the pixel's view ray.
vec3 radiance_of_ends(uint index) {
    uint row = index / view.size.x;
    uvec2 at = uvec2(index - row * view.size.x, row);
    uint entry = continued_entry(at);
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < (entry & 7u); ++k) {
        uint end = continued_index(at, entry, k);
        sum += continued[end].surface != CONTINUED_NONE ? continued[end].throughput * continued_radiance[end].rgb : vec3(0.0);
    }
    return sum;
}
#endif

#if defined(FIRST_SHOT) && (defined(TRANSMISSION) || defined(OBJECT_SPACE_RADIANCE))
layout(std430, binding = BINDING_FIRST_SHOT) readonly buffer FirstShotBuffer { vec4 first_shot[]; };
#endif
#ifdef OBJECT_SPACE_RADIANCE
/// Radiance of the middle of a side as the solution knows it, without its glossy part, radiance units.
vec3 object_space_radiance(uint side) {
    PixelSurface p;
    p.side = side;
    uint id = patch_of_side(side);
    p.barycentric = packUnorm2x16(vec2(1.0 / 3.0));
    vec3 light = object_space_irradiance(p, false);
#ifdef PATCHES_ONLY
    return surfaces[id].emission.rgb + surfaces[id].albedo.rgb * light * inverse_pi;
#endif
#ifdef FIRST_SHOT
    light += first_shot[2u * id].rgb;
#endif
#ifdef CAUSTICS
    light = max(light + from_vertices(vertex_caustics_texels, p, false), 0.0);
#endif
    return surfaces[id].emission.rgb + surfaces[id].albedo.rgb * light * inverse_pi;
}
#endif

#ifdef TRANSMISSION
layout(std430, binding = BINDING_TRANSMITTANCE) readonly buffer TransmittanceBuffer { vec4 transmittance[]; };

/// What comes through from the other side; that light is known per patch.
vec3 transmitted_radiance(PixelSurface p) {
    vec4 t = transmittance[patch_of_side(p.side)];
    if (t.rgb == vec3(0.0)) {
        return vec3(0.0);
    }
    vec3 behind = object_space_irradiance(p, true);
#ifdef PATCHES_ONLY
    return t.rgb * behind * inverse_pi;
#endif
#ifdef FIRST_SHOT
    behind += first_shot[2u * floatBitsToUint(t.w)].rgb;
#endif
#ifdef CAUSTICS
    behind = max(behind + from_vertices(vertex_caustics_texels, p, true), 0.0);
#endif
    return t.rgb * behind * inverse_pi;
}
#endif

#if defined(GLOSSY) && defined(GLOSS_RAYS)
#include "octahedral.glsl"
#include "pixel_gloss.glsl"
#include "lobe_sampling.glsl"

/// Gloss of a pixel whose rays have looked at what the patches send into its lobe: that stands for samples which it does not
/// have yet, and outweighs few. own: sum of the samples, with their weight; otherwise: where no ray has been drawn.
/// Neither is lit by lights without extent, whose gloss is known.
vec3 gloss_beside_rays(uint index, PixelSurface p, vec3 own, float weight, vec3 otherwise) {
    vec4 rays = texelFetch(pixel_gloss_texels, int(view.size.x * view.size.y + index));
    if (rays.w <= 0.0) {
        return otherwise;
    }
#ifdef CONTINUED
    vec3 w_out = continued_towards(index);
#else
    vec3 w_out = normalize(view.eye.xyz - p.position);
#endif
    float cos_out = dot(vector_from_octahedral(unpackSnorm2x16(p.normal)), w_out);
    vec4 at_out;
    vec3 albedo = pixel_albedo(p);
    Brdf brdf = pixel_brdf(reflectance_record(facet_material(p.facet & PIXEL_FACET_MASK), p.albedo), albedo, cos_out, at_out);
    vec2 lobes = drawn_lobes(brdf);
    vec3 of_lobes = min(drawn_albedo(drawn_part(brdf, lobes), lobes, cos_out), albedo);
    vec3 by_rays = rays.rgb / rays.w - of_lobes * bundled_irradiance(index, p) * inverse_pi;
    return mix(by_rays, own / max(weight, 1e-6), weight / (weight + samples_of_patches));
}
#endif

#ifdef IES
#include "view_luminaires.glsl"

/// Radiance of the pixel's surface towards the eye, radiance units.
vec3 surface_radiance(uint index, PixelSurface p) {
#else
/// Radiance towards the eye, radiance units.
vec3 pixel_radiance(uint index, PixelSurface p) {
#endif
#if defined(MIRRORS) && !defined(CONTINUED)
    if ((p.facet & PIXEL_CONTINUED) != 0u) {
#ifdef AIR_BEFORE
        return radiance_of_ends(index) + sent_by_air(index, left_before(p.position));
#endif
        return radiance_of_ends(index);
    }
#endif
#ifdef AIR_BEFORE
    if (p.side == NO_PATCH && (p.facet & PIXEL_SKY) != 0u) {
        float left = left_before_sky(index);
        return left * background(index) + sent_by_air(index, left);
    }
    if (p.side == NO_PATCH) {
        return sent_by_air_before_black(index);
    }
#endif
    if (p.side == NO_PATCH) {
        return (p.facet & PIXEL_SKY) != 0u ? background(index) : vec3(0.0);
    }
#ifdef UNLIT
    if ((p.facet & PIXEL_UNLIT) != 0u) {
        return pixel_albedo(p) * (UNLIT_WHITE / view.display.x);
    }
#endif
    vec3 emitted = (p.facet & PIXEL_EMITTER) != 0u ? surfaces[patch_of_side(p.side)].emission.rgb : vec3(0.0);
    vec3 reflected = pixel_albedo(p) * blended_irradiance(index, p) * inverse_pi;
#ifdef TRANSMISSION
    reflected += transmitted_radiance(p);
#endif
#if defined(GLOSSY) && !defined(PATCHES_ONLY)
    RARELY((p.facet & PIXEL_GLOSSY) != 0u) {
        vec4 own = texelFetch(pixel_gloss_texels, int(index));
        float weight = pixel_weight(own, view.weights.x);
        vec3 gloss = own.rgb / max(weight, 1e-6) * confidence_of_gloss(index, p.side, shown_sum(index, p).w);
#ifdef GLOSS_RAYS
        gloss = gloss_beside_rays(index, p, own.rgb, weight, gloss);
#endif
#ifdef FIRST_SHOT
        gloss += texelFetch(pixel_first_shot_texels, int(view.size.x * view.size.y + index)).rgb;
#endif
        reflected = max(reflected + gloss, 0.0);
    }
#endif
#ifdef AIR_BEFORE
    float left = left_before(p.position);
    emitted *= left;
    reflected = left * reflected + sent_by_air(index, left);
#endif
#if defined(COATS) && !defined(CONTINUED)
    reflected += radiance_of_ends(index);  // by a smooth coat, or by a polished surface
#endif
    return emitted + reflected;
}

#ifdef IES
/// Radiance towards the eye, radiance units; w: share of the pixel that shows no luminaire.
vec4 radiance_and_surface_share(uint index, PixelSurface p) {
    vec4 sum = luminaires_before(index, p);
    if (sum.w > 0.0) {
        sum.rgb += sum.w * surface_radiance(index, p);
#if defined(MIRRORS) && !defined(CONTINUED)
        if ((p.facet & PIXEL_CONTINUED) != 0u) {
            uint row = index / view.size.x;
            uvec2 at = uvec2(index - row * view.size.x, row);
            sum.w *= continued_radiance[continued_index(at, continued_entry(at), 0u)].w;
        }
#endif
    }
    return sum;
}

vec3 pixel_radiance(uint index, PixelSurface p) { return radiance_and_surface_share(index, p).rgb; }
#endif
