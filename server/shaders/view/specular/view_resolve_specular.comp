// SPDX-License-Identifier: Apache-2.0
// Second part of a viewer's geometry buffer, for surfaces with a specular lobe: the base colour becomes the
// directional albedo at the angle of view, and the accumulated glossy part follows its surface point.
// Variants: GLOSSY, REPROJECT, MOVED, CONTINUED as in view_resolve.comp.
#include "layouts.glsl"
layout(local_size_x = SPECULAR_GROUP) in;
#include "scene_geometry.glsl"
#include "facets.glsl"
#include "mesh.glsl"
#include "sides.glsl"
#include "octahedral.glsl"
#include "pixel_albedo.glsl"
#include "pixel_sum.glsl"
#include "brdf.glsl"
#define SPECULAR_GROUPS_ACCESS readonly
#include "specular_groups.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(std430, binding = BINDING_PIXELS) buffer PixelBuffer { uvec4 pixels[]; };
#ifdef CONTINUED
#include "continued.glsl"
#endif
#ifdef GLOSSY
layout(std430, binding = BINDING_PIXEL_GLOSS) writeonly buffer PixelGlossBuffer { vec4 pixel_gloss[]; };
#endif
uniform uvec4 refreshed;      // as in view_resolve.comp
uniform float common_weight;
#ifdef REPROJECT
#include "reproject.glsl"
layout(binding = UNIT_OLD_PIXEL_GLOSS) uniform samplerBuffer old_gloss_texels;

/// Share of its weight that a glossy part keeps when the point is seen from another direction: what has turned
/// by less than a lobe's width still looks about the same.
float kept_gloss(vec3 from_eye, vec3 from_old_eye, Brdf brdf) {
    if (brdf.kind == LOBE_GGX && brdf.f90 <= 0.0) {  // nothing but a Lambert part, which view rays show the lobe over
        return 1.0;
    }
    float alpha = brdf.kind == LOBE_MAX_PHONG ? sqrt(2.0 / (brdf.width + 2.0)) : brdf.width;
    vec3 turn = normalize(from_eye) - normalize(from_old_eye);
    return 1.0 / (1.0 + 16.0 * dot(turn, turn) / (alpha * alpha));
}

#if defined(CONTINUED) && defined(REPROJECT)
/// What the same end of the ray had: nothing that its light depends on has changed.
vec4 kept_gloss_of(uint index) {
    uint old_index = continued[index].old_index;
    return old_index == hidden ? vec4(0.0) : carried(texelFetch(old_gloss_texels, int(old_index)), kept_weight);
}
#endif

vec4 reprojected_gloss(vec3 position, uvec4 p, uvec4 q, Brdf brdf) {
    uvec3 triangle = triangle_of(p.w).xyz;
    uint object = object_of_triangle(triangle);
    vec2 v = unpackUnorm2x16(q.z);
    vec3 old_position = position_before(position, object, triangle, vec3(1.0 - v.x - v.y, v));
    uint index = old_pixel(old_position, side_normal(p.w), p.w, object);
    if (index == hidden) {
        return vec4(0.0);
    }
    float share = kept_weight * kept_gloss(position - view.eye.xyz, position - old_eye, brdf);
    return carried(texelFetch(old_gloss_texels, int(index)), share);
}
#endif

void main() {
    uint index = specular_pixel();
    uvec2 at = uvec2(index % view.size.x, index / view.size.x);
    if (any(lessThan(at, refreshed.xy)) || any(greaterThanEqual(at, refreshed.zw))) {
        return;
    }
    uvec4 p = pixels[2u * index];
    uvec4 q = pixels[2u * index + 1u];
    uint material = p.w == NO_PATCH ? 0u : facet_material(q.w & PIXEL_FACET_MASK);
    if (p.w == NO_PATCH || int(texelFetch(reflectance_texels, 3 * int(material) + 2).z) == LOBE_NONE) {
        return;
    }
    vec3 position = uintBitsToFloat(p.xyz);
    Brdf brdf = make_brdf(reflectance_record(material, q.y), unpack_albedo(q.y));
#ifdef CONTINUED
    vec3 w_out = continued_towards(index);
#else
    vec3 w_out = normalize(view.eye.xyz - position);
#endif
    vec3 normal = vector_from_octahedral(unpackSnorm2x16(q.x));
    vec3 albedo = brdf_albedo(brdf, brdf_at(brdf, dot(normal, w_out)));
    pixels[2u * index + 1u].y = pack_albedo(albedo, unpack_place(q.y), index, 1u);
#ifdef GLOSS_RAYS
    pixel_gloss[view.size.x * view.size.y + index] = vec4(0.0);
#endif
#ifdef GLOSSY
#if defined(CONTINUED) && defined(REPROJECT)
    pixel_gloss[index] = kept_gloss_of(index) - vec4(0.0, 0.0, 0.0, common_weight);
#elif defined(REPROJECT)
    pixel_gloss[index] = reprojected_gloss(position, p, q, brdf) - vec4(0.0, 0.0, 0.0, common_weight);
#else
    pixel_gloss[index] = vec4(0.0, 0.0, 0.0, -common_weight);
#endif
#endif
}
