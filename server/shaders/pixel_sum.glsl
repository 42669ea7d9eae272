// SPDX-License-Identifier: Apache-2.0
// Accumulated irradiance of a viewer's pixel: rgb = weighted sum, w = weight that the pixel brought along
// when it was last resolved. All pixels see every bundle, so what they have gained since is one number
// for all of them, and samples that are zero need no memory access.

/// Weight of a pixel's sum; common = ViewParameters::weights.x.
float pixel_weight(vec4 pixel_sum, float common_weight) { return pixel_sum.w + common_weight; }

vec3 pixel_mean(vec4 pixel_sum, float common_weight) {
    float weight = pixel_weight(pixel_sum, common_weight);
    return weight > 0.0 ? pixel_sum.rgb / weight : vec3(0.0);
}
