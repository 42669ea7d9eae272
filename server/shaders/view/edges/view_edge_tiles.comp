// SPDX-License-Identifier: Apache-2.0
// Lists the tiles of a viewer's picture with edge pixels.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(std430, binding = BINDING_EDGE_COUNTS) readonly buffer EdgeCountBuffer { uint edge_counts[]; };
#define TILE_LISTS 1
#define TILES_ACCESS
#include "tiles.glsl"

void main() {
    uint tile = linear_index();
    if (tile >= tile_count()) {
        return;
    }
    uint any = 0u;
    for (uint k = 0u; k < VIEW_TILE * VIEW_TILE; ++k) {
        uvec2 at = min(tile_pixel(tile, k), view.size.xy - 1u);
        uint index = at.y * view.size.x + at.x;
        any |= edge_counts[2u * index] | edge_counts[2u * index + 1u];
    }
    if (any != 0u) {
        tiles[atomicAdd(tile_commands[0].w, 1u)] = tile;
    }
}
