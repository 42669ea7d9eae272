// SPDX-License-Identifier: Apache-2.0
// Lists of tiles of VIEW_TILE x VIEW_TILE pixels of a viewer, TILE_LISTS of them: what only some tiles need runs
// there alone. The order of a list depends on the run, what is done for each tile does not.
layout(std430, binding = BINDING_TILES) TILES_ACCESS buffer TileBuffer {
    uvec4 tile_commands[TILE_LISTS];  // of glDispatchComputeIndirect; w: tiles of the list
    uint tiles[];                     // list after list, each with room for all tiles
};

const uint tiles_a_row = 32768u;  // work groups along x

uint tile_columns() { return (view.size.x + VIEW_TILE - 1u) / VIEW_TILE; }

uint tile_count() { return tile_columns() * ((view.size.y + VIEW_TILE - 1u) / VIEW_TILE); }

/// Pixel k (0 .. VIEW_TILE^2 - 1) of a tile; may lie beyond the picture.
uvec2 tile_pixel(uint tile, uint k) {
    uint row = tile / tile_columns();
    return VIEW_TILE * uvec2(tile - row * tile_columns(), row) + uvec2(k % VIEW_TILE, k / VIEW_TILE);
}

/// Tile of this work group, in a list or among all; one beyond the picture where there are more groups than tiles.
uint tile_of_group(bool listed, uint list) {
    uint k = gl_WorkGroupID.y * tiles_a_row + gl_WorkGroupID.x;
    uint all = tile_count();
    if (!listed) {
        return min(k, all);
    }
    return k < tile_commands[list].w ? tiles[list * all + k] : all;
}
