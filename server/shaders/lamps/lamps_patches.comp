// SPDX-License-Identifier: Apache-2.0
// Adds the light of a row of slots to sums of some patches, at the points of lamps_patch_points.comp.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "scene_geometry.glsl"
#include "mesh.glsl"
#ifndef FACETS
#include "facets.glsl"
#endif
#include "first_shot.glsl"
#include "lamps.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
#ifdef GLOSSY
#include "gloss.glsl"
#endif
layout(std430, binding = BINDING_LAMP_ORDER) readonly buffer LampOrderBuffer { uint lamp_order[]; };
/// Of each patch irradiance and what glossy ones reflect of it beyond their albedo, of the lamps looked at and of the
/// others, by chance.
layout(std430, binding = BINDING_LAMP_SUMS) buffer LampSumBuffer { vec4 lamp_sums[]; };
/// Of each patch LAMP_CHANCES lamps drawn and their weights (bits); 0: they do not reach it.
layout(std430, binding = BINDING_LAMP_CHANCES) readonly buffer LampChanceBuffer { uvec2 lamp_chances[]; };
uniform uint first_patch;
uniform uint end_patch;
uniform uint parts;
uniform float sign;
uniform bool chances;

void main() {
    uint i = linear_index();
    uint at = first_patch + i;
    if (at >= end_patch) {
        return;
    }
    uint patch_id = lamp_order[at];
    vec3 irradiance = vec3(0.0);
    vec3 gloss = vec3(0.0);
    vec3 w_in;
#ifdef GLOSSY
    bool glossy = is_glossy(patch_id);
#endif
    uint row = lamp_cells[patch_id] * LAMP_SLOTS;
    for (uint part = 0u; part < parts; ++part) {
        LampPoint point = lamp_points[i * parts + part];
        uint mask = lamp_masks[i * parts + part];
        for (uint slot = 0u; slot < LAMP_SLOTS; ++slot) {
            RARELY((mask >> slot & 1u) != 0u) {
                vec3 arriving = lamp_irradiance(lamp_slots[row + slot], point.position, point.normal, w_in);
                irradiance += arriving;
#ifdef GLOSSY
                RARELY(glossy) {
                    Brdf brdf = patch_brdf(patch_id);
                    gloss += arriving * (brdf_albedo(brdf, brdf_at(brdf, dot(point.normal, w_in))) - surfaces[patch_id].albedo.rgb);
                }
#endif
            }
        }
    }
    float share = sign / float(parts);
    lamp_sums[3u * patch_id] += vec4(share * irradiance, 0.0);
    lamp_sums[3u * patch_id + 1u] += vec4(share * gloss, 0.0);
    if (!chances) {
        return;
    }
    irradiance = vec3(0.0);
    LampPoint point = lamp_points[i * parts];
    for (uint k = 0u; k < LAMP_CHANCES; ++k) {
        uvec2 chance = lamp_chances[i * LAMP_CHANCES + k];
        RARELY(chance.y != 0u) {
            point = lamp_points[i * parts + k % parts];
            irradiance += uintBitsToFloat(chance.y) * lamp_irradiance(chance.x, point.position, point.normal, w_in);
        }
    }
    lamp_sums[3u * patch_id + 2u] = vec4(irradiance, 0.0);
}
