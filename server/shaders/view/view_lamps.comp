// SPDX-License-Identifier: Apache-2.0
// Many lamps at the pixels of a viewer (view/pixel_lamps.h). Steps: pixels begin with what their patches have; rows of slots are
// added; what has been added counts, with what the patches have of the lamps that have not been looked at.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "scene_geometry.glsl"
#include "mesh.glsl"
#include "sides.glsl"
#include "octahedral.glsl"
#include "luminance.glsl"
#ifdef GLOSSY
#include "pixel_gloss.glsl"
#endif
#ifndef FACETS
#include "facets.glsl"
#endif
#include "first_shot.glsl"
#include "lamps.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
#ifdef CONTINUED
#include "continued.glsl"
#endif
/// Irradiance per pixel (radiance units), w: its variance (luminance); in GLOSSY scenes the glossy radiance follows.
layout(std430, binding = BINDING_PIXEL_FIRST_SHOT) buffer PixelFirstShotBuffer { vec4 pixel_first_shot[]; };
/// The same of the lamps that have been looked at.
layout(std430, binding = BINDING_LAMP_PIXELS) buffer LampPixelBuffer { vec4 lamp_pixels[]; };
layout(std430, binding = BINDING_FIRST_SHOT) readonly buffer FirstShotBuffer { vec4 first_shot[]; };
layout(std430, binding = BINDING_LAMP_LEVELS) readonly buffer LampLevelBuffer { vec4 lamp_levels[]; };

uniform uint step_kind;
uniform uint first_pixel;
uniform uint end_pixel;
uniform uint patch_count;
uniform uint level;
uniform bool all_lamps;  // have been looked at
uniform float sign;

/// What is left to the patches lies between none and twice what they have, evenly.
float variance_of_rest(vec3 rest) {
    float light = luminance(rest);
    return light * light / 3.0;
}

void add_row(uint i, uint index, uint pixels, uvec4 q) {
    LampPoint point = lamp_points[i];
    uint mask = lamp_masks[i];
    if (point.cell == 0xffffffffu || mask == 0u) {
        return;
    }
    vec3 irradiance = vec3(0.0);
    vec3 gloss = vec3(0.0);
    vec3 normal = vector_from_octahedral(unpackSnorm2x16(q.x));
#ifdef GLOSSY
    bool glossy = (q.w & PIXEL_GLOSSY) != 0u;
    vec3 albedo = unpack_albedo(q.y);
#ifdef CONTINUED
    vec3 w_out = continued_towards(index);
#else
    vec3 w_out = normalize(view.eye.xyz - point.position);
#endif
    vec4 at_out;
    uint record = reflectance_record(facet_material(q.w & PIXEL_FACET_MASK), q.y);
    Brdf brdf = pixel_brdf(record, albedo, dot(normal, w_out), at_out);
#endif
    for (uint slot = 0u; slot < LAMP_SLOTS; ++slot) {
        RARELY((mask >> slot & 1u) != 0u) {
            uint k = lamp_slots[point.cell * LAMP_SLOTS + slot];
            vec3 w_in;
            vec3 arriving = lamp_irradiance(k, point.position, normal, w_in);
            irradiance += arriving;
#ifdef GLOSSY
            RARELY(glossy && arriving != vec3(0.0)) {
                vec4 at_in = brdf_at(brdf, dot(normal, w_in));
                vec3 value = brdf_value(brdf, normal, w_in, w_out, at_in.z * at_out.z);
#ifdef COATS
                value += punctual[k].profile.y == 0u ? traced_value(brdf, record, normal, w_in, w_out) : vec3(0.0);
#endif
                gloss += arriving * (value - albedo * brdf_inverse_pi);
            }
#endif
        }
    }
    if (step_kind == LAMPS_ADD) {
        lamp_pixels[index].rgb += sign * irradiance;
    } else {
        pixel_first_shot[index].rgb = max(pixel_first_shot[index].rgb + sign * irradiance, 0.0);
    }
#ifdef GLOSSY
    if (step_kind == LAMPS_ADD) {
        lamp_pixels[pixels + index].rgb += sign * gloss;
    } else {
        pixel_first_shot[pixels + index].rgb += sign * gloss;
    }
#endif
}

void main() {
    uint i = linear_index();
    uint index = first_pixel + i;
    if (index >= end_pixel) {
        return;
    }
    uint pixels = view.size.x * view.size.y;
    uint side = texelFetch(pixel_texels, int(2u * index)).w;
    uvec4 q = texelFetch(pixel_texels, int(2u * index + 1u));
    if (step_kind == LAMPS_BEGIN || step_kind == LAMPS_COUNT) {
        bool counts = step_kind == LAMPS_COUNT;
        vec3 known = counts ? lamp_pixels[index].rgb : vec3(0.0);
        vec3 rest = vec3(0.0);
        if (side != NO_PATCH && !all_lamps) {
            uint id = patch_of_side(side);
            vec3 of_level = counts ? lamp_levels[level * patch_count + id].rgb : vec3(0.0);
            rest = max(first_shot[2u * id].rgb - of_level, 0.0);
        }
        pixel_first_shot[index] = vec4(known + rest, variance_of_rest(rest));
        if (!counts) {
            lamp_pixels[index] = vec4(0.0);
        }
#ifdef GLOSSY
        vec4 gloss = counts ? lamp_pixels[pixels + index] : vec4(0.0);
        pixel_first_shot[pixels + index] = gloss;
        if (!counts) {
            lamp_pixels[pixels + index] = vec4(0.0);
        }
#endif
        return;
    }
    add_row(i, index, pixels, q);
}
