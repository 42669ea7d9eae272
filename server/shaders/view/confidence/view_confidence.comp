// SPDX-License-Identifier: Apache-2.0
// From the sums over tiles (view_confidence_look.comp) what view_confidence.glsl needs.
//
// Noise of neighbouring pixels is alike, so that D^2 of a tile is hardly better known than by one number: D^2 minus its noise
// would let a third of pure noise pass. So tiles have the b^2 that is usual in the picture, and where D is beyond three standard
// deviations, what it says itself, for it is a shadow or a corner that patches do not resolve. What is usual is known best while
// patches have seen no more than the pixels, since D has no noise then; it is a mean of |D| over tiles, so that few corners do
// not decide. A turn leaves it as it is.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "group_sum.glsl"
layout(std430, binding = BINDING_CONFIDENCE_SUMS) readonly buffer TileSumBuffer { vec4 tile_sums[]; };
layout(std430, binding = BINDING_CONFIDENCE) buffer ConfidenceBuffer { vec2 light[]; };
uniform uint columns;
uniform uint rows;
uniform bool whole;  // the whole picture, by one work group; else its tiles
const float sure = 9.0;  // three standard deviations, squared

struct Tile {
    vec4 differences;
    vec4 scatter;
};

Tile tile_at(uint tile) { return Tile(tile_sums[2u * tile], tile_sums[2u * tile + 1u]); }

/// Of single samples, over the squared light, as far as the tile has probes and samples enough to say so.
float variance_in(Tile tile, float usual) {
    float pixels = max(tile.differences.w, 1.0);
    float samples = pixels / max(tile.scatter.z, 1e-30);
    float own = tile.scatter.x / max(tile.scatter.y, 1.0) / max(tile.differences.z / pixels, 1e-30);
    float known = tile.scatter.y > 0.0 ? samples / (samples + float(GROUP_SIZE)) : 0.0;
    return mix(usual, own, known);
}

/// D^2 and its noise, over the squared light.
vec2 found_in(Tile tile, float variance) {
    float pixels = max(tile.differences.w, 1.0);
    return vec2(tile.differences.x / max(tile.differences.z, 1e-30), variance * tile.differences.y / pixels);
}

/// b^2 over the squared light by what was known of it and by one more look; y: its uncertainty. A look is off by as much as
/// the noise that it has to take away, or by itself where it has none.
vec2 joined(vec2 known, vec2 look) {
    float known_error = known.y * known.y + 1e-30;
    float look_error = look.y * look.y + 1e-30;
    if (light[1].y <= 0.0) {
        return look;
    }
    float weight = known_error / (known_error + look_error);  // of the look
    return vec2(mix(known.x, look.x, weight), sqrt(weight * look_error));
}

void whole_picture() {
    vec4 sums = vec4(0.0);  // variance of samples at probes, squared light there, pixels
    for (uint k = gl_LocalInvocationID.x; k < columns * rows; k += 64u) {
        Tile tile = tile_at(k);
        float squared_light = tile.differences.z / max(tile.differences.w, 1.0);
        sums += vec4(tile.scatter.x, squared_light * tile.scatter.y, tile.differences.w, 0.0);
    }
    sums = group_sum(sums);
    if (gl_LocalInvocationID.x == 0u) {
        group_sums[0] = sums;
    }
    barrier();
    sums = group_sums[0];
    barrier();
    float usual = sums.x / max(sums.y, 1e-30);
    vec4 known = vec4(0.0);  // |b|, noise, pixels
    for (uint k = gl_LocalInvocationID.x; k < columns * rows; k += 64u) {
        Tile tile = tile_at(k);
        vec2 found = found_in(tile, usual);
        known += tile.differences.w * vec4(sqrt(max(found.x - found.y, 0.0)), found.y, 1.0, 0.0);
    }
    known = group_sum(known);
    if (gl_LocalInvocationID.x == 0u && sums.y > 0.0 && known.z > 0.0) {
        float bias = known.x / known.z;
        vec2 now = vec2(bias * bias, max(known.y / known.z, bias * bias));
        vec2 result = joined(vec2(light[0].y, light[1].x), now);
        light[0] = vec2(usual, result.x);
        light[1] = vec2(result.y, 1.0);
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
        sum.scatter += one.scatter;
    }
    return sum;
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
    // Noise by many pixels, and what is beyond it by few.
    Tile near = around(number);
    float variance = max(variance_in(near, light[0].x), light[0].x);
    Tile tile = tile_at(number);
    vec2 found = found_in(tile, variance);
    float own = max(1.0 - sure * found.y / max(found.x, 1e-30), 0.0) * max(found.x - found.y, 0.0);
    light[CONFIDENCE_WHOLE + number] = vec2(variance, tile.differences.w > 0.0 ? max(light[0].y, own) : light[0].y);
}
