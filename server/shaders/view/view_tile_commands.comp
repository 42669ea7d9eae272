// SPDX-License-Identifier: Apache-2.0
// Sizes of the dispatches over lists of tiles, see tiles.glsl.
#include "layouts.glsl"
layout(local_size_x = 1) in;
layout(std430, binding = BINDING_TILES) buffer TileBuffer { uvec4 tile_commands[]; };

const uint tiles_a_row = 32768u;

void main() {
    uint count = tile_commands[gl_WorkGroupID.x].w;
    tile_commands[gl_WorkGroupID.x].xyz = uvec3(min(count, tiles_a_row), (count + tiles_a_row - 1u) / tiles_a_row, 1u);
}
