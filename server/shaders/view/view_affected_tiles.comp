// SPDX-License-Identifier: Apache-2.0
// Finds the tiles of a viewer that the difference between bundles before and after a move can reach: where a ray
// along which some pixel of the tile looks passes a box that holds a moved object at either place.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
// A list for each pair of bundles, and in GLOSSY scenes one more of the tiles with glossy pixels.
#define TILE_LISTS (2 * MOST_DIFFERENCES)
#define TILES_ACCESS
#include "tiles.glsl"
uniform uint bundle_count;
uniform uint box_count;
uniform vec4 bundle_rays[2 * MOST_DIFFERENCES];  // shooting point (w = 1) or direction (w = 0); x: spread, m
uniform vec4 boxes[2 * MOST_BOXES];              // lower and upper corners, m

const float far_away = 1e30;

/// What a tile shows.
struct Tile {
    vec3 low, high;  // bounds of its surface points, m
    bool plain, glossy;
};

Tile load_tile(uint tile) {
    Tile t = Tile(vec3(far_away), vec3(-far_away), false, false);
    for (uint k = 0u; k < VIEW_TILE * VIEW_TILE; ++k) {
        uvec2 at = min(tile_pixel(tile, k), view.size.xy - 1u);
        int index = int(at.y * view.size.x + at.x);
        uvec4 p = texelFetch(pixel_texels, 2 * index);
        bool receives = p.w != NO_PATCH;
        vec3 position = uintBitsToFloat(p.xyz);
        t.low = receives ? min(t.low, position) : t.low;
        t.high = receives ? max(t.high, position) : t.high;
#ifdef GLOSSY
        bool glossy = (texelFetch(pixel_texels, 2 * index + 1).w & PIXEL_GLOSSY) != 0u;
        t.plain = t.plain || receives && !glossy;
        t.glossy = t.glossy || receives && glossy;
#else
        t.plain = t.plain || receives;
#endif
    }
    return t;
}

/// Whether a ray from inside the tile's bounds may pass a box. All rays lie within half the bounds' extent of the
/// one from their middle (towards a shooting point: closer and closer), so the box is grown by that.
bool reaches(Tile t, vec4 rays, float spread, vec3 box_low, vec3 box_high) {
    vec3 middle = 0.5 * (t.low + t.high);
    vec3 margin = 0.5 * (t.high - t.low) + spread;
    vec3 direction = rays.w > 0.0 ? rays.xyz - middle : rays.xyz;
    direction = mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
    vec3 a = (box_low - margin - middle) / direction;
    vec3 b = (box_high + margin - middle) / direction;
    vec3 first = min(a, b);
    vec3 last = max(a, b);
    float entry = max(first.x, max(first.y, first.z));
    float leaving = min(last.x, min(last.y, last.z));
    return entry <= leaving && (rays.w <= 0.0 || (leaving >= 0.0 && entry <= 1.0));
}

void list(uint tile, uint k) {
    uint at = atomicAdd(tile_commands[k].w, 1u);
    tiles[k * tile_count() + at] = tile;
}

void main() {
    uint tile = linear_index();
    if (tile >= tile_count()) {
        return;
    }
    Tile t = load_tile(tile);
    if (t.low.x > t.high.x) {
        return;
    }
    for (uint k = 0u; k < bundle_count; ++k) {
        bool reached = false;
        for (uint i = 0u; i < box_count; ++i) {
            reached = reached || reaches(t, bundle_rays[2u * k], bundle_rays[2u * k + 1u].x, boxes[2u * i].xyz,
                                         boxes[2u * i + 1u].xyz);
        }
        if (reached && t.plain) {
            list(tile, k);
        }
#ifdef GLOSSY
        if (reached && t.glossy) {
            list(tile, MOST_DIFFERENCES + k);
        }
#endif
    }
}
