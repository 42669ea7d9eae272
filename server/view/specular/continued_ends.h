// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gpu/layouts.h"
#include "solution/specular/specular_rays.h"
#include "view/camera_matrices.h"

namespace raybundle {

/// The ends of a picture's view rays that mirrors and glass deflect, as continued.glsl has them.
struct ContinuedEnds {
    std::vector<std::uint32_t> tiles;          ///< of the picture: first end tile * 8 + number
    std::vector<layout::ContinuedPixel> ends;  ///< tile after tile, VIEW_TILE^2 each
    [[nodiscard]] std::size_t tile_count() const { return ends.size() / (VIEW_TILE * VIEW_TILE); }
};

/// Follows the rays through the pixels of the tiles that may show a specular surface. view: of the
/// picture; hidden: objects that it does not show. Deterministic: seeds are the pixels' numbers.
ContinuedEnds find_continued_ends(const SpecularRays& rays, const layout::ViewParameters& view,
                                  std::span<const std::uint32_t> hidden = {});

/// Puts the ends into rows of `columns` tiles, so that they are pixels of a picture of their own
/// with `rows` rows of tiles; what is left over is not used.
std::vector<layout::ContinuedPixel> in_rows(const ContinuedEnds& found, unsigned columns,
                                            unsigned rows);
/// Number that an end has there; end: in ContinuedEnds::ends.
std::uint32_t index_in_rows(std::size_t end, unsigned columns);

/// Tells each end which one of the picture before is the very same: same pixel, place in the
/// scene and direction there. Both pictures of one size, the old ends in rows of old_columns.
void match_ends(ContinuedEnds& found, const ContinuedEnds& old, unsigned old_columns);

}  // namespace raybundle
