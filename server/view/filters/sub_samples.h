// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "gpu/layouts.h"

namespace raybundle {

/// The k-th of EDGE_SAMPLES places in a pixel, from its centre, pixels: within (-0.5, 0.5), y
/// upwards. Each has a row and a column of its own of a 16 x 16 grid, and a cell of a 4 x 4 one.
glm::vec2 sub_sample(unsigned k);

/// Where the pixels of a picture are looked at, from their centres, pixels: [STAGGER_PERIOD * y +
/// x] is that of the pixels whose column and row leave the remainders x and y.
using PixelPlaces = std::array<glm::vec2, STAGGER_PERIOD * STAGGER_PERIOD>;

/// For pixels that are parts of larger ones, grid x grid each (a power of two). At their centres
/// they would see an edge or a slot along the rows of the picture from `grid` distances alone; here
/// no two parts in a block of 2 x 2 or 4 x 4 have a row or a column in common. 1: the centres.
PixelPlaces staggered_places(unsigned grid);

/// Such places for the shaders, and what they say of a pixel.
void set_places(layout::ViewParameters& view, const PixelPlaces& places);
glm::vec2 place_in_pixel(const layout::ViewParameters& view, glm::uvec2 pixel);

}  // namespace raybundle
