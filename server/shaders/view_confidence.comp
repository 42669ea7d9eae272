// SPDX-License-Identifier: Apache-2.0
// From the sums over tiles (view_confidence_look.comp) what view_confidence.glsl needs.
//
// v: samples say how much they scatter in a tile, by many samples; of the whole picture follows which share of that is in D
// (patches have part of the noise of their pixels' samples), by all tiles. Where a tile has few samples, those of the whole
// picture count as much as one group of iterations. What has gone of the variance since the last look, of half as many
// samples, is as much as is left where samples are independent. Where they avoid each other more goes, by what two looks
// in a row say.
// b^2: noise of neighbouring pixels is alike, so that D^2 of a tile is hardly better known than by one number: 1 - N/D^2, N =
// v/n, would let a third of pure noise pass. So tiles have what all have in the mean, over their squared light; and where D is
// beyond three standard deviations, what it says itself, for it is a shadow or a corner that patches do not resolve. Where few
// samples have brought next to nothing they do not scatter either, so that so many are asked for that by the scatter of
// tiles near by light is not missed by chance.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "group_sum.glsl"
layout(std430, binding = BINDING_CONFIDENCE_SUMS) readonly buffer TileSumBuffer { vec4 tile_sums[]; };
layout(std430, binding = BINDING_CONFIDENCE) buffer ConfidenceBuffer { vec2 light[]; };
uniform uint columns;
uniform uint rows;
uniform bool whole;  // the whole picture, by one work group; else its tiles
uniform bool again;  // there has been a look before the last one
uniform float most_decay;  // of the variance by twice as many samples
const float sure = 9.0;  // three standard deviations, squared
const float missed = 5.9;  // events of a rate are missed with the same probability: exp(-5.9) = 0.0027

struct Tile {
    vec4 differences;
    vec4 light;
};

float scatter_of(Tile tile) { return tile.light.z / max(tile.light.w, 1.0); }

/// D^2 of a pixel, N, and what D^2 is beyond doubt. share: v over the samples' variance; usual: that over the squared light.
struct Found {
    float square, noise, doubt;
};

Found found_in(Tile tile, float variance, float share, float usual) {
    float pixels = max(tile.light.x, 1.0);
    float inverse_samples = tile.differences.w / pixels;
    float noise = variance * inverse_samples;
    float usual_noise = share * usual * (tile.light.y / pixels) * inverse_samples;
    return Found(tile.differences.z / pixels, noise, sure * max(noise, usual_noise));
}

Tile tile_at(uint tile) { return Tile(tile_sums[2u * tile], tile_sums[2u * tile + 1u]); }

/// b^2 over the squared light by what was known of it and by one more look; y: its uncertainty. A look is off by as much as
/// the noise that it has to take away; what is known of another view, by b^2 itself besides.
vec2 joined(vec2 known, vec2 look) {
    float known_error = known.y * known.y + (again ? 0.0 : known.x * known.x);
    float look_error = look.y * look.y;
    if (known.y <= 0.0 || known_error + look_error <= 0.0) {
        return vec2(max(look.x, 0.0), look.y);
    }
    float weight = known_error / (known_error + look_error);  // of the look
    return vec2(max(mix(known.x, look.x, weight), 0.0), sqrt(weight * look_error));
}

void whole_picture() {
    vec4 sums = vec4(0.0);  // change^2, what it were of all the samples' variance, P^2, variance of a sample
    for (uint k = gl_LocalInvocationID.x; k < columns * rows; k += 64u) {
        Tile tile = tile_at(k);
        float scatter = scatter_of(tile);
        sums += vec4(tile.differences.x, scatter * tile.differences.y, tile.light.y, scatter * tile.light.x);
    }
    sums = group_sum(sums);
    if (gl_LocalInvocationID.x == 0u) {
        group_sums[0] = sums;
    }
    barrier();
    sums = group_sums[0];
    barrier();
    float gone = sums.y > 0.0 ? sums.x / sums.y : 0.0;
    float before = light[2].y;
    barrier();
    float decay = again && gone > 0.0 ? clamp(2.0 * before / gone, 2.0, most_decay) : 2.0;
    float share = gone / (decay - 1.0);
    float usual = sums.w / max(sums.z, 1e-30);
    vec4 known = vec4(0.0);  // D^2 - N, as far as that is what tiles have in common, P^2, 1/n, pixels
    for (uint k = gl_LocalInvocationID.x; k < columns * rows; k += 64u) {
        Tile tile = tile_at(k);
        Found found = found_in(tile, share * scatter_of(tile), share, usual);
        float bias = min(found.square, found.doubt) - found.noise;
        known += vec4(bias * tile.light.x, tile.light.y, tile.differences.w, tile.light.x);
    }
    known = group_sum(known);
    if (gl_LocalInvocationID.x == 0u && sums.z > 0.0) {
        float noise = share * usual * known.z / max(known.w, 1.0);
        vec2 bias = joined(vec2(light[0].y, light[2].x), vec2(known.x / max(known.y, 1e-30), noise));
        light[0] = vec2(share * usual, bias.x);
        light[1] = vec2(share, usual);
        light[2] = vec2(bias.y, gone);
    }
}

/// Sums over a tile and the eight round it.
Tile around(uint tile) {
    ivec2 at = ivec2(tile % columns, tile / columns);
    Tile sum = Tile(vec4(0.0), vec4(0.0));
    for (int k = 0; k < 9; ++k) {
        ivec2 other = clamp(at + ivec2(k % 3, k / 3) - 1, ivec2(0), ivec2(columns, rows) - 1);
        Tile one = tile_at(uint(other.y) * columns + uint(other.x));
        sum.differences += one.differences;
        sum.light += one.light;
    }
    return sum;
}

/// Variance of samples over the squared light near a tile, some of which has been reached by light that has missed the rest by
/// chance. Light that comes with a share r of the samples has 1/r.
float scatter_near(uint tile) {
    const int reach = 3;
    ivec2 at = ivec2(tile % columns, tile / columns);
    vec2 sum = vec2(0.0);
    for (int y = max(at.y - reach, 0); y <= min(at.y + reach, int(rows) - 1); ++y) {
        for (int x = max(at.x - reach, 0); x <= min(at.x + reach, int(columns) - 1); ++x) {
            Tile other = tile_at(uint(y) * columns + uint(x));
            sum += vec2(scatter_of(other) * other.light.x, other.light.y);
        }
    }
    return sum.y > 0.0 ? sum.x / sum.y : 0.0;
}

void main() {
    if (whole) {
        whole_picture();
        return;
    }
    uint number = gl_GlobalInvocationID.x;
    if (number >= columns * rows) {
        return;
    }
    Tile tile = around(number);
    float pixels = max(tile.light.x, 1.0);
    float squared_light = tile.light.y / pixels;
    float samples = pixels / max(tile.differences.w, 1e-30);
    float usual = light[1].y * squared_light;
    float scatter = mix(usual, scatter_of(tile), samples / (samples + float(GROUP_SIZE)));
    float variance = light[1].x * scatter;
    Found found = found_in(tile, variance, light[1].x, 0.0);
    float own = max(1.0 - found.doubt / max(found.square, 1e-30), 0.0) * max(found.square - found.noise, 0.0);
    own = samples > missed * scatter_near(number) ? own : 0.0;
    light[CONFIDENCE_WHOLE + number] = vec2(variance, max(light[0].y * squared_light, own));
}
