// SPDX-License-Identifier: Apache-2.0
// A glossy patch takes a sample: main part, scale and chain of the random representation (ch. 7.2, with
// the positive importance of reflectance_table.h in the place of a luminance).
#include "density.glsl"
#include "scene_geometry.glsl"
#include "gloss.glsl"
#include "patch_members.glsl"
#include "sides.glsl"
#include "random_hash.glsl"
#include "rarely.glsl"
#ifdef FIRST_SHOT
#include "first_shot.glsl"
#ifdef MANY_LAMPS
/// Cell of each patch; of each cell lamps drawn, and the inverse of how many of them it is (bits).
layout(std430, binding = BINDING_LAMP_CELLS) readonly buffer LampCellBuffer { uint lamp_cells[]; };
layout(std430, binding = BINDING_LAMP_PROPOSALS) readonly buffer LampProposalBuffer { uvec2 lamp_proposals[]; };
#endif
#endif
layout(std430, binding = BINDING_GLOSS) buffer GlossBuffer { uvec4 gloss[]; };
layout(std430, binding = BINDING_CHAIN) buffer ChainBuffer { vec2 chain[]; };
uniform bool perspective;        // the bundle that the sample came by
uniform uint iteration_number;   // any number, different for every iteration

/// Where the sample came from.
LightSource incoming_source(uint patch_id, vec3 normal) {
    vec3 axis = bundle.axis_z.xyz;
    LightSource source = LightSource(dot(axis, normal) < 0.0 ? -axis : axis, 0.0);
    if (perspective) {
        uvec3 triangle = load_triangle(floatBitsToUint(patch_attributes(patch_id).w)).xyz;
        source = source_at(bundle.origin.xyz, centroid_of(triangle, 0u));
    }
    return source;
}

#ifdef FIRST_SHOT
/// Light of one of the punctual lights, drawn evenly, at a random point of the patch, so that its mean is what all of
/// them bring. Its main part is known (patch_source.glsl): it is only a proposal for the chain.
vec3 propose_punctual(uint patch_id, vec3 normal, out LightSource source) {
    vec3 u = random_numbers_of(patch_id, iteration_number ^ 0x5bd1e995u);
    float share = u.x;
    uint side = side_within(patch_id, share);
    uvec3 t = triangle_of(side).xyz;
    normal = member_count(patch_id) > 1u ? side_normal(side) : normal;
    float root = sqrt(share);
    vec3 point = world_position(t.x) * (1.0 - root) + world_position(t.y) * (root * (1.0 - u.y)) +
                 world_position(t.z) * (root * u.y);
    vec3 w_in;
#ifdef MANY_LAMPS  // those that reach no patch of the cell are not among the drawn ones
    uvec2 drawn = lamp_proposals[lamp_cells[patch_id] * LAMP_SLOTS + min(uint(u.z * float(LAMP_SLOTS)), LAMP_SLOTS - 1u)];
    uint k = drawn.x;
    vec3 to_light;
    vec3 arriving = unhindered_irradiance(punctual[k], point, normal, to_light, w_in) * uintBitsToFloat(drawn.y);
#else
    uint k = min(uint(u.z * float(punctual_count)), punctual_count - 1u);
    vec3 arriving = punctual_irradiance(k, point, normal, normal, NO_HIT, w_in) * float(punctual_count);
#endif
    source = LightSource(punctual[k].axis_z.xyz, 0.0);
    if (punctual[k].map.z != PUNCTUAL_DIRECTIONAL) {
        uvec3 largest = load_triangle(floatBitsToUint(patch_attributes(patch_id).w)).xyz;
        source = source_at(punctual[k].position.xyz, centroid_of(largest, 0u));
    }
    return arriving;
}
#endif

/// Takes irradiance I of this iteration (0 where nothing came) with the step of the iterate. reflected: main
/// part L_d of the reflected radiance so far; returns the new one.
vec3 update_gloss(uint patch_id, vec3 irradiance, vec3 reflected, float step) {
    vec3 normal = patch_plane(patch_id).xyz;
    LightSource source = LightSource(normal, 0.0);
    vec3 sample_radiance = vec3(0.0);
    float importance = 0.0;
    RARELY(irradiance != vec3(0.0)) {
        source = incoming_source(patch_id, normal);
        Brdf brdf = patch_brdf(patch_id);
        float cosine = dot(normal, source.direction);
#ifdef PATCH_SETS  // light from below the mean plane of several triangles has no lobe about its normal
        vec4 at_in = brdf_at(brdf, abs(cosine));
        at_in.w = cosine > 0.0 ? at_in.w : 0.0;
#else
        vec4 at_in = brdf_at(brdf, cosine);
#endif
        sample_radiance = brdf_albedo(brdf, at_in) * irradiance * brdf_inverse_pi;
        vec3 magnitude = abs(irradiance);
        importance = max(magnitude.r, max(magnitude.g, magnitude.b)) * at_in.w;
    }
    float picked = importance;  // of the proposal, of all that came in in this iteration
#ifdef FIRST_SHOT
    LightSource punctual_source;
    vec3 direct = propose_punctual(patch_id, normal, punctual_source);
    RARELY(direct != vec3(0.0)) {
        Brdf brdf = patch_brdf(patch_id);
        vec4 at_in = brdf_at(brdf, dot(normal, punctual_source.direction));
        float other = max(direct.r, max(direct.g, direct.b)) * at_in.w;
        importance += other;
        if (random_numbers_of(patch_id, iteration_number).y * importance < other) {
            irradiance = direct;
            source = punctual_source;
            picked = other;
        }
    }
#endif
    vec2 state = chain[patch_id];  // s_m, C
    float scale = state.y + (importance - state.y) * step;
    uvec4 g = gloss[patch_id];
    float chance = random_numbers_of(patch_id, iteration_number).x;
    if (importance > 0.0 && chance * state.x < importance) {
        g = pack_gloss(irradiance * (scale / picked), source);
        state.x = importance;
    } else {
        float change = state.y > 0.0 ? scale / state.y : 0.0;
        g.y = floatBitsToUint(uintBitsToFloat(g.y) * change);
    }
    gloss[patch_id] = g;
    chain[patch_id] = vec2(state.x, scale);
    return reflected + (sample_radiance - reflected) * step;
}
