// SPDX-License-Identifier: Apache-2.0
// What lines through the point of a bundle from an opening carry inwards: light of the sky where they meet nothing outside,
// and what surfaces send that the sky lights. The bundle's second picture shows what the same pixels' lines meet in the
// opposite direction. Requires scene_geometry.glsl, facets.glsl and radiance_slope.glsl.
#include "sky_openings.glsl"
#include "equirectangular.glsl"
layout(binding = UNIT_OUTSIDE_IDS) uniform usampler2D outside_ids;
layout(binding = UNIT_CARRIED_SKY) uniform sampler2D carried_sky_texels;

/// Radiance from a unit direction, radiance units, less the constant term.
vec3 sky_towards(vec3 direction) {
    vec3 sky = bundle.sky.rgb;
    if (bundle.sky_behind.w > 0.0) {
        sky += bundle.sky_behind.w * textureLod(carried_sky_texels, equirectangular(direction), 0.0).rgb;
    }
    return sky;
}

/// What comes to x, on a patch, through the bundle's point: radiance over the density of the line, radiance units times
/// sr. texel: of the line; towards: unit, from x to the point; way: between them, m. found: inverse of the density, sr.
vec3 light_through(ivec2 texel, uint patch_x, vec3 x, vec3 towards, float way, out float found) {
    uint surface = texelFetch(outside_ids, texel, 0).r;
    found = 0.0;
    if (surface == NO_HIT) {
        float density = bundle.densities.x + opening_density(x, towards, 1e12);
        found = density > 0.0 ? 1.0 / density : 0.0;
        vec3 sky = found * sky_towards(towards);
#ifdef MEDIUM
        sky *= left_by_air_from_sky(x, towards);
#endif
        return sky;
    }
    Facet facet = load_facet(facet_base + (surface >> 1));
    float along = dot(facet.plane.xyz, towards);
    float beyond = (facet.plane.w - dot(facet.plane.xyz, bundle.origin.xyz)) / (abs(along) > 1e-7 ? along : 1e-7);
    vec3 weights;
    uint triangle = triangle_at(facet, bundle.origin.xyz + beyond * towards, weights);
    // To the rasteriser the second picture is mirrored, so that it takes fronts for backs.
    uint y = patch_of_surface(2u * triangle + (along > 0.0 ? 1u : 0u));
    if (beyond <= 0.0 || !openings_carry(y, patch_x)) {
        return vec3(0.0);
    }
    float r = way + beyond;
    vec4 l = radiance_at(y, weights);
    found = cosine_over_density(r, abs(along), l.w, opening_density(x, towards, r));
#ifdef MEDIUM
    l.rgb *= left_by_air(r);
#endif
    return found * l.rgb;
}
