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
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
#ifdef CONTINUED
#include "continued.glsl"
#endif
/// Irradiance per pixel (radiance units); in GLOSSY scenes the glossy radiance of all pixels follows.
layout(std430, binding = BINDING_PIXEL_FIRST_SHOT) buffer PixelFirstShotBuffer { vec4 pixel_first_shot[]; };

uniform uint first_light;  // of those that this dispatch adds
uniform uint end_light;

void main() {
    uint index = linear_index();
    uint pixels = view.size.x * view.size.y;
    if (index >= pixels) {
        return;
    }
    uvec4 p = texelFetch(pixel_texels, int(2u * index));       // position, patch
    uvec4 q = texelFetch(pixel_texels, int(2u * index + 1u));  // normal, albedo, barycentric, facet
    vec3 irradiance = first_light == 0u ? vec3(0.0) : pixel_first_shot[index].rgb;
    vec3 gloss = vec3(0.0);
#ifdef GLOSSY
    gloss = first_light == 0u ? gloss : pixel_first_shot[pixels + index].rgb;
#endif
    RARELY(p.w != NO_PATCH) {
        // The surface point itself: the stored one is kept away from creases.
        uvec3 t = triangle_of(p.w).xyz;
        vec2 v = unpackUnorm2x16(q.z);
        vec3 position =
            world_position(t.x) * (1.0 - v.x - v.y) + world_position(t.y) * v.x + world_position(t.z) * v.y;
        vec3 normal = vector_from_octahedral(unpackSnorm2x16(q.x));
        vec3 geometric = side_normal(p.w);
        uint facet = q.w & PIXEL_FACET_MASK;
#ifdef GLOSSY
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
            vec3 w_in;
            vec3 arriving = punctual_irradiance(k, position, normal, geometric, facet, w_in);
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
    pixel_first_shot[index] = vec4(irradiance, 0.0);
#ifdef GLOSSY
    pixel_first_shot[pixels + index] = vec4(gloss, 0.0);
#endif
}
