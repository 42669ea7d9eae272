// SPDX-License-Identifier: Apache-2.0
// Accumulated irradiance of a viewer's pixel: rgb = weighted sum, w = weight that the pixel brought along
// when it was last resolved. All pixels see every bundle, so what they have gained since is one number
// for all of them, and samples that are zero need no memory access.

/// Weight of a pixel's sum; common = ViewParameters::weights.x.
float pixel_weight(vec4 pixel_sum, float common_weight) { return pixel_sum.w + common_weight; }

#ifdef CONSTANT_RADIANCE
#include "octahedral.glsl"
/// Share of pi that the constant radiance 1 gives to a pixel as irradiance: below 1 where the shading normal
/// tilts, since light comes from the facet's side only. packed_normal, facet: of PixelSurface.
float constant_share(uint packed_normal, uint facet) {
    vec4 plane = texelFetch(facet_texels, int(4u * (facet & PIXEL_FACET_MASK)));
    return 0.5 + 0.5 * abs(dot(plane.xyz, vector_from_octahedral(unpackSnorm2x16(packed_normal))));
}
#endif

vec3 pixel_mean(vec4 pixel_sum, float common_weight) {
    float weight = pixel_weight(pixel_sum, common_weight);
    return weight > 0.0 ? pixel_sum.rgb / weight : vec3(0.0);
}
