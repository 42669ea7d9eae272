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
#include "patch_members.glsl"
#include "sides.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
layout(std430, binding = BINDING_FIRST_SHOT) buffer FirstShotBuffer { vec4 first_shot[]; };
#ifdef GLOSSY
#include "gloss.glsl"
#endif
#ifdef TRANSMISSION
layout(std430, binding = BINDING_TRANSMITTANCE) readonly buffer TransmittanceBuffer { vec4 transmittance[]; };
#endif
uniform uint patch_count;
uniform bool radiance_follows;  // else change_source.comp lets it
uniform uint divisions;  // of each edge; a patch has its square of parts
uniform uint first_light;  // of those that this dispatch adds
uniform uint end_light;

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

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    bool whole = member_count(i) == 1u;
    uint parts = divisions * divisions;
    parts = whole ? parts : max(parts, min(member_count(i), most_places));
    float first_share = 0.0;
    Face face = face_of(side_within(i, first_share), patch_plane(i).xyz);
    vec3 irradiance = vec3(0.0);
    vec3 reflected = vec3(0.0);
#ifdef GLOSSY
    bool glossy = is_glossy(i);
#endif
    for (uint k = first_light; k < end_light; ++k) {
        vec3 sum = vec3(0.0);
        vec3 w_in;
        for (uint part = 0u; part < parts; ++part) {
            if (!whole) {
                float share = (float(part) + 0.5) / float(parts);
                uint side = side_within(i, share);
                face = face_of(side, side_normal(side));
            }
            vec3 arriving = punctual_irradiance(k, place_on(face, part, whole), face.normal, face.normal, NO_HIT, w_in);
            sum += arriving;
        }
        sum /= float(parts);
        irradiance += sum;
        vec3 albedo = surfaces[i].albedo.rgb;
#ifdef GLOSSY
        RARELY(glossy && sum != vec3(0.0)) {
            Brdf brdf = patch_brdf(i);
            albedo = brdf_albedo(brdf, brdf_at(brdf, dot(whole ? face.normal : patch_plane(i).xyz, w_in)));
        }
#endif
        reflected += albedo * sum * inverse_pi;
#ifdef TRANSMISSION
        RARELY(transmittance[i].rgb != vec3(0.0)) {
            vec3 behind = vec3(0.0);
            for (uint part = 0u; part < parts; ++part) {
                if (!whole) {
                    float share = (float(part) + 0.5) / float(parts);
                    uint side = side_within(i, share);
                    face = face_of(side, side_normal(side));
                }
                behind += punctual_irradiance(k, place_on(face, part, whole), -face.normal, -face.normal, NO_HIT, w_in);
            }
            reflected += transmittance[i].rgb * behind * (inverse_pi / float(parts));
        }
#endif
    }
    // The first dispatch takes back what there was before.
    vec3 change = reflected;
    if (first_light == 0u) {
        change -= first_shot[2u * i + 1u].rgb;
    } else {
        irradiance += first_shot[2u * i].rgb;
        reflected += first_shot[2u * i + 1u].rgb;
    }
    if (radiance_follows) {
        vec3 sent = radiance[i].rgb + change;
        radiance[i].rgb = end_light == punctual_count ? max(sent, 0.0) : sent;
    }
    first_shot[2u * i] = vec4(irradiance, 0.0);
    first_shot[2u * i + 1u] = vec4(reflected, patch_attributes(i).x);
}
