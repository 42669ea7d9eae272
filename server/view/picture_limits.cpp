// SPDX-License-Identifier: Apache-2.0
#include "view/picture_limits.h"

#include <algorithm>
#include <cmath>

#include "gpu/gl_limits.h"
#include "gpu/layouts.h"
#include "view/tiles/picture_tiles.h"

namespace raybundle {

PictureLimits picture_limits() {
    return {
        std::min(most_picture_edge(), PictureTiles::most_edge),
        std::min(PictureTiles::most_pixels, most_storage_bytes() / sizeof(layout::PixelSurface))};
}

glm::uvec2 fitted(glm::uvec2 wanted, const PictureLimits& limits) {
    const glm::dvec2 size(glm::max(wanted, glm::uvec2(1)));
    const double edges = static_cast<double>(limits.edge) / std::max(size.x, size.y);
    const double pixels = std::sqrt(static_cast<double>(limits.pixels) / (size.x * size.y));
    const double scale = std::min({1.0, edges, pixels});
    return glm::max(glm::uvec2(glm::floor(scale * size + 1e-9)), glm::uvec2(1));
}

}  // namespace raybundle
