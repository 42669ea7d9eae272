// SPDX-License-Identifier: Apache-2.0
// How much a pixel's own estimate S counts beside the light P of the patches, which is smooth but knows no detail finer
// than they are. With c of the difference D = S - P, P + c D has the least squared error where c = b^2 / E[D^2] =
// b^2 / (b^2 + v / n): b^2 is the squared error of P (its bias alone: noise that both share is not in D), v the variance
// of D by one sample. Both are measured in tiles of the picture (view_confidence.comp). The first texels are of the whole
// picture. 0: v and b^2 over the squared light, which are all that is known after a turn; 1: v over the samples' variance,
// and that over the squared light; 2: uncertainty of that b^2, and v by what had gone of the variance at the last look,
// over the samples' variance.
layout(binding = UNIT_CONFIDENCE) uniform samplerBuffer confidence_texels;

/// Samples of equal weight that a mean of this weight is worth. Samples from before the picture was last resolved have a
/// weight of 1 in it; those since rise from nothing at the start of a solve.
float effective_samples(float weight) {
    return weight * weight / max(weight - view.weights.y + view.weights.z, 1e-12);
}

vec2 light_of_tile(ivec2 tile, ivec2 tiles) {
    tile = clamp(tile, ivec2(0), tiles - 1);
    return texelFetch(confidence_texels, CONFIDENCE_WHOLE + tile.y * tiles.x + tile.x).xy;
}

/// x: v, y: b^2 round a pixel, to a common factor.
vec2 local_light(uint index) {
    ivec2 tiles = ivec2(view.confidence.xy);
    if (tiles.x == 0) {
        return texelFetch(confidence_texels, 0).xy;
    }
    uint row = index / view.size.x;
    vec2 at = (vec2(index - row * view.size.x, row) + 0.5) / view.confidence.z - 0.5;
    ivec2 corner = ivec2(floor(at));
    vec2 f = at - vec2(corner);
    vec2 below = mix(light_of_tile(corner, tiles), light_of_tile(corner + ivec2(1, 0), tiles), f.x);
    vec2 above = mix(light_of_tile(corner + ivec2(0, 1), tiles), light_of_tile(corner + ivec2(1, 1), tiles), f.x);
    return mix(below, above, f.y);
}

/// c of a pixel whose own mean has this weight.
float confidence(uint index, float weight) {
    vec2 light = local_light(index);
    float signal = light.y * effective_samples(weight);
    return weight > 0.0 && signal > 0.0 ? signal / (signal + light.x) : 0.0;
}
