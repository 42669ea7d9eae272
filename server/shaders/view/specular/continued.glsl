// SPDX-License-Identifier: Apache-2.0
// Pixels behind the picture, where the view rays of its specular pixels end (view/specular/specular_view.h). They come in
// tiles: for each tile of the picture that shows a mirror or glass anywhere there is a row of up to four tiles, the
// first with the strongest end of every pixel, at the pixel's own place in the tile, the next with the second.
layout(std430, binding = BINDING_CONTINUED) readonly buffer ContinuedBuffer { ContinuedPixel continued[]; };

#ifdef CONTINUED
/// Unit, from a continued pixel's surface point back along its ray.
vec3 continued_towards(uint index) { return vector_from_octahedral(unpackSnorm2x16(continued[index].towards)); }
#else
layout(std430, binding = BINDING_CONTINUED_TILES) readonly buffer ContinuedTileBuffer {
    uint continued_columns;  // continued tiles in a row
    uint continued_tiles[];  // for each tile of the picture: first of its continued tiles * 8 + number of them
};

/// Entry of a pixel's tile.
uint continued_entry(uvec2 at) {
    uint columns = (view.size.x + VIEW_TILE - 1u) / VIEW_TILE;
    return continued_tiles[at.y / VIEW_TILE * columns + at.x / VIEW_TILE];
}

/// Number of a pixel's k-th end.
uint continued_index(uvec2 at, uint entry, uint k) {
    uint tile = (entry >> 3) + k;
    uint row = tile / continued_columns;
    uvec2 inside = at % VIEW_TILE;
    return (VIEW_TILE * row + inside.y) * VIEW_TILE * continued_columns +
           VIEW_TILE * (tile - row * continued_columns) + inside.x;
}

/// Whether a pixel shows nothing but what its view ray ends at.
bool is_continued(uvec2 at) {
    uint entry = continued_entry(at);
    if ((entry & 7u) == 0u) {
        return false;
    }
    uint end = continued_index(at, entry, 0u);
    return continued[end].surface != CONTINUED_NONE && continued[end].added == 0u;
}
#endif
