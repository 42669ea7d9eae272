// SPDX-License-Identifier: Apache-2.0
// Incoming first shot (ch. 4.3.1): mean irradiance of every patch by the punctual lights, over the centroids of
// the patch's equal parts, and the main part of the radiance that it makes. Source of the random iteration.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "scene_geometry.glsl"
#include "mesh.glsl"
#ifndef FACETS
#include "facets.glsl"
#endif
#define SHADOW_RAYS
#include "first_shot.glsl"
#include "shot_pass.glsl"
#include "patch_members.glsl"
#include "sides.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
layout(std430, binding = BINDING_FIRST_SHOT) buffer FirstShotBuffer { vec4 first_shot[]; };
layout(std430, binding = BINDING_FIRST_SHOT_REST) buffer FirstShotRestBuffer { vec4 first_shot_rest[]; };
#ifdef GLOSSY
#include "gloss.glsl"
#endif
#ifdef TRANSMISSION
layout(std430, binding = BINDING_TRANSMITTANCE) readonly buffer TransmittanceBuffer { vec4 transmittance[]; };
#endif
uniform uint patch_count;
uniform bool radiance_follows;  // else change_source.comp lets it
uniform uint divisions;  // of each edge; a patch has its square of parts
layout(std430, binding = BINDING_SHOT_MASKS) buffer ShotMaskBuffer { uint shot_masks[]; };
uniform uint mask_words;    // of a patch
uniform bool whole_lights;  // a change reaches those that it reaches everywhere
uniform bool ends;  // the last dispatch of the last pass
// What SHOT_RENEW does, and the other passes leave out: patches of objects that move, or of a material. NO_PATCH: none.
uniform uvec4 moved_objects;
uniform uint renewed_material;

const float inverse_pi = 0.31830988618;
const uint most_places = 32u;  // of a patch of several triangles

/// Barycentric weights of corners 1 and 2 at the centroid of the k-th of divisions^2 equal parts.
vec2 part_centroid(uint k) {
    uint row = uint(sqrt(float(k) + 0.5));
    uint column = k - row * row;  // 0 .. 2 row: upright parts are even
    float third = (column & 1u) == 0u ? 1.0 / 3.0 : 2.0 / 3.0;
    float down = float(row) + 1.0 - third;  // from corner 0
    float across = float(column >> 1) + third;
    return vec2(down - across, across) / float(divisions);
}

/// A triangle on which light is looked for.
struct Face {
    vec3 normal;
    vec3 a, e1, e2;
};

Face face_of(uint side, vec3 normal) {
    uvec3 t = triangle_of(side).xyz;
    vec3 a = world_position(t.x);
    return Face(normal, a, world_position(t.y) - a, world_position(t.z) - a);
}

/// Where light is looked for on a face, whole: all of them are on this one, each in a part of its own.
vec3 place_on(Face face, uint place, bool whole) {
    // Else they are on faces by area: places of an additive sequence.
    vec2 u = fract(vec2(0.5) + float(place) * vec2(0.75487767, 0.56984029));
    vec2 at = whole ? part_centroid(place) : u.x + u.y > 1.0 ? 1.0 - u : u;
    return face.a + at.x * face.e1 + at.y * face.e2;
}

bool is_renewed(uint i) {
    float share = 0.0;
    uint material = triangle_of(side_within(i, share)).w & MATERIAL_MASK;
    return any(equal(moved_objects, uvec4(floatBitsToUint(patch_attributes(i).z)))) || material == renewed_material;
}

/// Mean irradiance of a patch by light k, of its parts. w_in: from the last of them. facing: 1, or -1 for the back of a patch.
vec3 mean_irradiance(uint i, uint k, Face face, bool whole, uint parts, float facing, out vec3 w_in) {
    vec3 sum = vec3(0.0);
    for (uint part = 0u; part < parts; ++part) {
        if (!whole) {
            float share = (float(part) + 0.5) / float(parts);
            uint side = side_within(i, share);
            face = face_of(side, side_normal(side));
        }
        vec3 normal = facing * face.normal;
        sum += punctual_irradiance(k, place_on(face, part, whole), normal, normal, NO_HIT, w_in);
    }
    return sum / float(parts);
}

/// Whether a change reaches the light of light k.
bool is_reached(uint i, uint k) {
    return whole_shot() || whole_lights || (shot_masks[i * mask_words + (k >> 5)] >> (k & 31u) & 1u) != 0u;
}

bool any_reached(uint i) {
    bool any = false;
    for (uint k = first_light; k < end_light; ++k) {
        any = any || is_reached(i, k);
    }
    return any;
}

/// Notes which lights a change reaches on any part of a patch.
void find_reached(uint i, Face face, bool whole, uint parts) {
    for (uint word = 0u; word < mask_words; ++word) {
        shot_masks[i * mask_words + word] = 0u;
    }
    for (uint part = 0u; part < parts; ++part) {
        if (!whole) {
            float share = (float(part) + 0.5) / float(parts);
            uint side = side_within(i, share);
            face = face_of(side, side_normal(side));
        }
        vec3 place = place_on(face, part, whole);
        for (uint k = first_light; k < end_light; ++k) {
            RARELY(may_be_touched(k, place)) {
                shot_masks[i * mask_words + (k >> 5)] |= is_touched(k, place) ? 1u << (k & 31u) : 0u;
            }
        }
    }
}

void main() {
    uint i = linear_index();
    if (i >= patch_count || (shot_pass != SHOT_ALL && is_renewed(i) != (shot_pass == SHOT_RENEW))) {
        return;
    }
    if (shot_pass != SHOT_FIND && !any_reached(i)) {
        return;
    }
    bool whole = member_count(i) == 1u;
    uint parts = divisions * divisions;
    parts = whole ? parts : max(parts, min(member_count(i), most_places));
    float first_share = 0.0;
    Face face = face_of(side_within(i, first_share), patch_plane(i).xyz);
    if (shot_pass == SHOT_FIND) {
        find_reached(i, face, whole, parts);
        return;
    }
    vec3 before = first_shot[2u * i + 1u].rgb;
    bool anew = begins && whole_shot();
    vec3 irradiance = anew ? vec3(0.0) : first_shot[2u * i].rgb;
    vec3 irradiance_rest = anew ? vec3(0.0) : first_shot_rest[2u * i].rgb;
    vec3 reflected = anew ? vec3(0.0) : before;
    vec3 reflected_rest = anew ? vec3(0.0) : first_shot_rest[2u * i + 1u].rgb;
#ifdef GLOSSY
    bool glossy = is_glossy(i);
#endif
    for (uint k = first_light; k < end_light; ++k) {
        RARELY(is_reached(i, k)) {
            vec3 w_in;
            vec3 sum = mean_irradiance(i, k, face, whole, parts, 1.0, w_in);
            add_light(irradiance, irradiance_rest, sum);
            vec3 albedo = surfaces[i].albedo.rgb;
#ifdef GLOSSY
            RARELY(glossy && sum != vec3(0.0)) {
                Brdf brdf = patch_brdf(i);
                albedo = brdf_albedo(brdf, brdf_at(brdf, dot(whole ? face.normal : patch_plane(i).xyz, w_in)));
            }
#endif
            vec3 made = albedo * sum * inverse_pi;
#ifdef TRANSMISSION
            RARELY(transmittance[i].rgb != vec3(0.0)) {
                vec3 behind = mean_irradiance(i, k, face, whole, parts, -1.0, w_in);
                made += transmittance[i].rgb * behind * inverse_pi;
            }
#endif
            add_light(reflected, reflected_rest, made);
        }
    }
    end_sum(irradiance, irradiance_rest);
    end_sum(reflected, reflected_rest);
    if (radiance_follows) {
        vec3 sent = radiance[i].rgb + (reflected - before);
        radiance[i].rgb = ends ? max(sent, 0.0) : sent;
    }
    first_shot[2u * i] = vec4(irradiance, 0.0);
    first_shot[2u * i + 1u] = vec4(reflected, patch_attributes(i).x);
    first_shot_rest[2u * i] = vec4(irradiance_rest, 0.0);
    first_shot_rest[2u * i + 1u] = vec4(reflected_rest, 0.0);
}
