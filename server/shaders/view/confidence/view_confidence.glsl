// SPDX-License-Identifier: Apache-2.0
// How much a pixel's own mean S of n samples counts beside the light P of the patches, a mean of N >= n, of which they have seen
// the same n. P is off by b, since it knows no detail finer than patches; the rest of their difference D = S - P is noise of the
// variance v (1/n - 1/N), for what both have seen is in both. P + c D has the least squared error where c = b^2 / (b^2 + v (1/n -
// 1/N)): where patches have seen no more than the pixel, nothing speaks for them. Both v and b^2 are measured in tiles of the
// picture (view_confidence.comp). The first texels are of the whole picture. 0: v and b^2 over the squared light, all that is
// known after a turn; 1: x: uncertainty of that b^2, y: 1 once anything is known.
layout(binding = UNIT_CONFIDENCE) uniform samplerBuffer confidence_texels;
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer MeanBuffer { vec4 mean_irradiance[]; };

/// Samples that outweigh a patch's light, which is interpolated, where both have seen the same.
const float samples_of_patches = 6.0;
/// No b^2 over the squared light is below this: half a step of 8 bits, 0.5/255 at a display's gamma of 2.2, is not seen.
const float invisible = 1.9e-5;

/// Samples of equal weight that a mean of this weight is worth. Samples from before the picture was last resolved have a
/// weight of 1 in it; those since rise from nothing at the start of a solve.
float effective_samples(float weight) {
    return weight * weight / max(weight - view.weights.y + view.weights.z, 1e-12);
}

/// Variance of the mean of so many samples over that of one, view/error/error_interval.h.
float variance_share(float samples) {
    return pow(max(samples / view.gain.y, 1.0), -view.gain.x) / max(samples, 1e-6);
}

/// The same of a patch's mean, by sequences of several workers that know nothing of each other.
float variance_share_of_patch(float samples) {
    return variance_share(samples / view.gain.z) / view.gain.z;
}

/// 1/n - 1/N of a pixel whose own mean has this weight, for low-discrepancy samples. Nothing below a thousandth of 1/n.
float patches_ahead(float weight, uint side) {
    float samples = effective_samples(weight);
    float ahead = samples * mean_irradiance[patch_of_side(side)].w / max(weight, 1e-12);
    return ahead > 1.001 * samples ? max(variance_share(samples) - variance_share_of_patch(ahead), 0.0) : 0.0;
}

vec2 light_of_tile(ivec2 tile, ivec2 tiles) {
    tile = clamp(tile, ivec2(0), tiles - 1);
    return texelFetch(confidence_texels, CONFIDENCE_WHOLE + tile.y * tiles.x + tile.x).xy;
}

/// x: v, y: b^2 round a pixel, over the squared light of its patches.
vec2 local_light(uint index) {
    ivec2 tiles = ivec2(view.confidence.xy);
    vec2 whole = texelFetch(confidence_texels, 0).xy;
    if (tiles.x == 0) {
        return whole;
    }
    uint row = index / view.size.x;
    vec2 at = (vec2(index - row * view.size.x, row) + 0.5) / view.confidence.z - 0.5;
    ivec2 corner = ivec2(floor(at));
    vec2 f = at - vec2(corner);
    vec2 below = mix(light_of_tile(corner, tiles), light_of_tile(corner + ivec2(1, 0), tiles), f.x);
    vec2 above = mix(light_of_tile(corner + ivec2(0, 1), tiles), light_of_tile(corner + ivec2(1, 1), tiles), f.x);
    return mix(below, above, f.y);
}

/// Weight of a pixel's own mean. Before the first look the light of patches that have seen more is shown. A picture too small for
/// probes looks in vain: its samples speak for themselves.
float confidence(uint index, uint side, float weight) {
    float own = weight / (weight + samples_of_patches);
    float ahead = weight > 0.0 ? patches_ahead(weight, side) : 0.0;
    if (ahead <= 0.0) {
        return own;
    }
    vec2 light = local_light(index);
    float bias = max(light.y, invisible);
    float known = texelFetch(confidence_texels, 1).y > 0.0 ? bias / (bias + light.x * ahead) : view.confidence.w;
    // Samples that outweigh the patches: n (1 - c) / c of each reason.
    return known > 0.0 ? 1.0 / (1.0 / own + 1.0 / known - 1.0) : 0.0;
}

/// The same of what own samples bring beyond the reflection of a Lambert surface, of which patches know nothing: all of it where
/// they have seen no more.
float confidence_of_gloss(uint index, uint side, float weight) {
    return weight > 0.0 ? confidence(index, side, weight) * (weight + samples_of_patches) / weight : 1.0;
}
