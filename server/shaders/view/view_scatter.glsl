// SPDX-License-Identifier: Apache-2.0
// Scatter of a probe pixel's samples, every iteration a sample y of weight w: sums of w y, (w y)^2 and w^2 y since they
// began. Samples that are zero need no memory access.
// Then, for view_statistics.comp alone: the first of them when statistics were made last, and by how much the samples of the
// last batch, from one of these to the next, were brighter than the mean of all before them; then sums of (W Y)^2 and W^2 Y of
// batches of weight W and mean Y.
layout(std430, binding = BINDING_PIXEL_SCATTER) buffer PixelScatterBuffer { float pixel_scatter[]; };

/// Mean of samples y of weight w, and in y the variance of that mean were the samples independent:
/// sum w^2 (y - mean)^2 / (sum w)^2, less the degree of freedom that the mean takes. sums: of w y, (w y)^2, w^2 y.
vec2 variance_of(vec3 sums, float weight, float squared_weight) {
    float mean = sums.x / weight;
    float square = max(sums.y - 2.0 * mean * sums.z + mean * mean * squared_weight, 0.0);
    return vec2(mean, square / max(weight * weight - squared_weight, 1e-6 * weight * weight));
}

/// The same of the luminance of all samples of a probe.
vec2 mean_and_variance(uint probe, float weight, float squared_weight) {
    return variance_of(vec3(pixel_scatter[SCATTER_SUMS * probe], pixel_scatter[SCATTER_SUMS * probe + 1u],
                            pixel_scatter[SCATTER_SUMS * probe + 2u]), weight, squared_weight);
}
