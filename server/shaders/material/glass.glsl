// SPDX-License-Identifier: Apache-2.0
// Glass (scene/material/specular_surface.h) lets bundles straight through, line by line; only pictures show it (SHOW_GLASS).
// What it absorbs (GLASS_ABSORBS) are single fragments, by chance: those stay, as a black surface. Punctual lights see
// through all of it (CLEAR_GLASS), since solution/specular/caustic_rays.h knows what of their light arrives.
// Only compiled where a scene has any (GLASS). For GLASS_ABSORBS the including shader declares uint facet_base of the
// place that is drawn.
#ifndef ALPHA_MASK
#ifndef FACETS
layout(binding = UNIT_FACETS) uniform samplerBuffer facet_texels;
#endif
layout(binding = UNIT_MATERIALS) uniform samplerBuffer material_texels;
#endif
#if defined(GLASS_ABSORBS) && !defined(CLEAR_GLASS)
#include "random_hash.glsl"

/// fresnel_reflectance() of scene/material/specular_surface.h.
float fresnel_reflectance(float cosine, float relative_index) {
    float sine2 = (1.0 - cosine * cosine) / (relative_index * relative_index);
    float behind = sqrt(max(1.0 - sine2, 0.0));
    float parallel = (relative_index * cosine - behind) / (relative_index * cosine + behind);
    float across = (cosine - relative_index * behind) / (cosine + relative_index * behind);
    return 0.5 * (parallel * parallel + across * across);
}

/// BundleGlass::passing_share().
float passing_share(float tint, float ior, float exponent, float cosine) {
    float f = fresnel_reflectance(cosine, ior);
    return pow(f + (1.0 - f) * (1.0 - f) * tint / max(1.0 - f * tint, 1e-6), exponent);
}

bool absorbs(uint facet, int material, float tint, vec3 direction, uint line) {
    vec3 normal = texelFetch(facet_texels, int(4u * (facet + facet_base))).xyz;
    float ior = texelFetch(material_texels, material + 2).w;
    float exponent = texelFetch(material_texels, material + 3).w;
    float cosine = min(abs(dot(normal, direction)), 1.0);
    uint of_bundle = floatBitsToUint(bundle.origin.x) ^ floatBitsToUint(bundle.axis_x.y);
    return random_numbers_of(facet, line ^ of_bundle).x >= passing_share(tint, ior, exponent, cosine);
}
#endif

/// Whether a line of a bundle goes on through a facet. direction: of the line, unit; line: any number of its own.
bool passes(uint facet, vec3 direction, uint line) {
    int material = 5 * int(floatBitsToUint(texelFetch(facet_texels, int(4u * facet + 3u)).w));
    float tint = texelFetch(material_texels, material + 1).w;
#if defined(GLASS_ABSORBS) && !defined(CLEAR_GLASS)
    return tint > 0.0 && (tint >= 1.0 || !absorbs(facet, material, tint, direction, line));
#else
    return tint > 0.0;
#endif
}
