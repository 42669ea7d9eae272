// SPDX-License-Identifier: Apache-2.0
// Scatter of a probe pixel's samples, every iteration a sample y of weight w: sums of w y, (w y)^2 and w^2 y since they
// began. Samples that are zero need no memory access.
layout(std430, binding = BINDING_PIXEL_SCATTER) readonly buffer PixelScatterBuffer { float pixel_scatter[]; };

/// Mean luminance of a probe's samples, and in y the variance of that mean were the samples independent:
/// sum w^2 (y - mean)^2 / (sum w)^2, less the degree of freedom that the mean takes.
vec2 mean_and_variance(uint probe, float weight, float squared_weight) {
    vec3 sums = vec3(pixel_scatter[SCATTER_SUMS * probe], pixel_scatter[SCATTER_SUMS * probe + 1u],
                     pixel_scatter[SCATTER_SUMS * probe + 2u]);
    float mean = sums.x / weight;
    float square = max(sums.y - 2.0 * mean * sums.z + mean * mean * squared_weight, 0.0);
    return vec2(mean, square / max(weight * weight - squared_weight, 1e-6 * weight * weight));
}
