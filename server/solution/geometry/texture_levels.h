// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// Appends the texels of a texture of colours, row by row, and behind them its levels: each of half
/// the width and height of the one before, rounded down, to a single texel. Their texels are means
/// of light over the areas they cover (L. Williams 1983, "Pyramidal parametrics"), encoded as the
/// texture's.
void append_colour_levels(const Texture& texture, std::vector<std::uint32_t>& texels);

/// Appends the texels of a texture alone.
void append_texels(const Texture& texture, std::vector<std::uint32_t>& texels);

}  // namespace raybundle
