// SPDX-License-Identifier: Apache-2.0
// A glossy patch takes a sample: main part, scale and chain of the random representation (ch. 7.2, with
// the positive importance of reflectance_table.h in the place of a luminance).
#include "density.glsl"
#include "scene_geometry.glsl"
#include "gloss.glsl"
#include "random_hash.glsl"
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

/// Takes irradiance I of this iteration (0 where nothing came) with the step of the iterate. reflected: main
/// part L_d of the reflected radiance so far; returns the new one.
vec3 update_gloss(uint patch_id, vec3 irradiance, vec3 reflected, float step) {
    vec3 normal = patch_plane(patch_id).xyz;
    LightSource source = LightSource(normal, 0.0);
    vec3 sample_radiance = vec3(0.0);
    float importance = 0.0;
    for (bool lit = irradiance != vec3(0.0); lit; lit = false) {
        source = incoming_source(patch_id, normal);
        Brdf brdf = patch_brdf(patch_id);
        vec4 at_in = brdf_at(brdf, dot(normal, source.direction));
        sample_radiance = brdf_albedo(brdf, at_in) * irradiance * brdf_inverse_pi;
        vec3 magnitude = abs(irradiance);
        importance = max(magnitude.r, max(magnitude.g, magnitude.b)) * at_in.w;
    }
    vec2 state = chain[patch_id];  // s_m, C
    float scale = state.y + (importance - state.y) * step;
    uvec4 g = gloss[patch_id];
    float chance = random_numbers_of(patch_id, iteration_number).x;
    if (importance > 0.0 && chance * state.x < importance) {
        g = pack_gloss(irradiance * (scale / importance), source);
        state.x = importance;
    } else {
        float change = state.y > 0.0 ? scale / state.y : 0.0;
        g.y = floatBitsToUint(uintBitsToFloat(g.y) * change);
    }
    gloss[patch_id] = g;
    chain[patch_id] = vec2(state.x, scale);
    return reflected + (sample_radiance - reflected) * step;
}
