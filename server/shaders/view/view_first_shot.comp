// SPDX-License-Identifier: Apache-2.0
// Incoming first shot (ch. 4.3.1) at the pixels of a viewer: irradiance by the punctual lights, and in GLOSSY scenes
// what their light adds to the picture beyond the directional albedo, see pixel_gloss.glsl.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "scene_geometry.glsl"
#include "mesh.glsl"
#include "sides.glsl"
#include "octahedral.glsl"
#ifdef GLOSSY
#include "pixel_gloss.glsl"
#endif
#ifndef FACETS
#include "facets.glsl"
#endif
#define SHADOW_RAYS
#include "first_shot.glsl"
#include "shot_pass.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
#ifdef CONTINUED
#include "continued.glsl"
#endif
/// Irradiance per pixel (radiance units); in GLOSSY scenes the glossy radiance of all pixels follows.
layout(std430, binding = BINDING_PIXEL_FIRST_SHOT) buffer PixelFirstShotBuffer { vec4 pixel_first_shot[]; };
layout(std430, binding = BINDING_PIXEL_SHOT_REST) buffer PixelShotRestBuffer { vec4 pixel_shot_rest[]; };

uniform uvec4 shot_pixels;      // [x, z) x [y, w): those that are looked at
uniform uint renewed_material;  // SHOT_RENEW: its pixels alone; NO_PATCH: all

// Of the lights of this dispatch, SHOT_LIGHTS at most: PunctualData::touched_cone, and their places.
uniform vec4 touched_cones[SHOT_LIGHTS];
uniform vec4 light_places[SHOT_LIGHTS];

/// Lights of this dispatch that a change reaches at a point, bit by bit. The cones come as uniforms, since a software
/// rasteriser takes longer to read buffers than to decide.
uint reached_lights(vec3 position) {
    uint near = 0u;
    for (uint i = 0u; i < uint(SHOT_LIGHTS); ++i) {
        vec3 d = position - light_places[i].xyz;
        near |= dot(touched_cones[i].xyz, d) >= touched_cones[i].w * length(d) ? 1u << i : 0u;
    }
    near &= (1u << (end_light - first_light)) - 1u;
    uint reached = 0u;
    RARELY(near != 0u) {
        for (uint i = 0u; i < end_light - first_light; ++i) {
            RARELY((near >> i & 1u) != 0u) {
                reached |= is_touched(first_light + i, position) ? 1u << i : 0u;
            }
        }
    }
    return reached;
}

/// Adds the light of some of the lights to a pixel, or takes it back.
void shoot(uint index, uvec4 p, uvec4 q, vec3 position, uint lights) {
    uint pixels = view.size.x * view.size.y;
    vec3 irradiance = pixel_first_shot[index].rgb;
    vec3 irradiance_rest = pixel_shot_rest[index].rgb;
    vec3 normal = vector_from_octahedral(unpackSnorm2x16(q.x));
    vec3 geometric = side_normal(p.w);
    uint facet = q.w & PIXEL_FACET_MASK;
#ifdef GLOSSY
    vec3 gloss = pixel_first_shot[pixels + index].rgb;
    vec3 gloss_rest = pixel_shot_rest[pixels + index].rgb;
    bool glossy = (q.w & PIXEL_GLOSSY) != 0u;
    vec3 albedo = unpack_albedo(q.y);
#ifdef CONTINUED
    vec3 w_out = continued_towards(index);
#else
    vec3 w_out = normalize(view.eye.xyz - position);
#endif
    vec4 at_out;
    uint record = reflectance_record(facet_material(facet), q.y);
    Brdf brdf = pixel_brdf(record, albedo, dot(normal, w_out), at_out);
#endif
    for (uint k = first_light; k < end_light; ++k) {
        RARELY((lights >> (k - first_light) & 1u) != 0u) {
            vec3 w_in;
            vec3 arriving = punctual_irradiance(k, position, normal, geometric, facet, w_in);
            add_light(irradiance, irradiance_rest, arriving);
#ifdef GLOSSY
            RARELY(glossy && arriving != vec3(0.0)) {
                vec4 at_in = brdf_at(brdf, dot(normal, w_in));
                vec3 value = brdf_value(brdf, normal, w_in, w_out, at_in.z * at_out.z);
#ifdef COATS
                value += punctual[k].profile.y == 0u ? traced_value(brdf, record, normal, w_in, w_out) : vec3(0.0);
#endif
                add_light(gloss, gloss_rest, arriving * (value - albedo * brdf_inverse_pi));
            }
#endif
        }
    }
    end_sum(irradiance, irradiance_rest);
    pixel_first_shot[index] = vec4(irradiance, 0.0);
    pixel_shot_rest[index] = vec4(irradiance_rest, 0.0);
#ifdef GLOSSY
    pixel_first_shot[pixels + index] = vec4(gloss, 0.0);
    pixel_shot_rest[pixels + index] = vec4(gloss_rest, 0.0);
#endif
}

void main() {
    uint i = linear_index();
    uvec2 size = shot_pixels.zw - shot_pixels.xy;
    if (i >= size.x * size.y) {
        return;
    }
    uint index = (shot_pixels.y + i / size.x) * view.size.x + shot_pixels.x + i % size.x;
    uvec4 p = texelFetch(pixel_texels, int(2u * index));       // position, patch
    uvec4 q = texelFetch(pixel_texels, int(2u * index + 1u));  // normal, albedo, barycentric, facet
    uint facet = p.w == NO_PATCH ? 0u : q.w & PIXEL_FACET_MASK;
    if (shot_pass == SHOT_RENEW && renewed_material != NO_PATCH && facet_material(facet) != renewed_material) {
        return;
    }
    if (begins && whole_shot()) {
        pixel_first_shot[index] = vec4(0.0);
        pixel_shot_rest[index] = vec4(0.0);
#ifdef GLOSSY
        uint pixels = view.size.x * view.size.y;
        pixel_first_shot[pixels + index] = vec4(0.0);
        pixel_shot_rest[pixels + index] = vec4(0.0);
#endif
    }
    RARELY(p.w != NO_PATCH) {
        // The surface point itself: the stored one is kept away from creases.
        uvec3 t = triangle_of(p.w).xyz;
        vec2 v = unpackUnorm2x16(q.z);
        vec3 position =
            world_position(t.x) * (1.0 - v.x - v.y) + world_position(t.y) * v.x + world_position(t.z) * v.y;
        uint lights = whole_shot() ? 0xffffffffu : 0u;
        RARELY(lights == 0u) {
            lights = reached_lights(position);
        }
        RARELY(lights != 0u) {
            shoot(index, p, q, position, lights);
        }
    }
}
