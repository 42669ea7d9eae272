// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace raybundle {

/// How large a picture that is drawn at once may be.
struct PictureLimits {
    unsigned edge = 1;       ///< pixels
    std::size_t pixels = 1;  ///< of all
};

/// Those of PictureTiles, or less where the driver of the current context takes less.
PictureLimits picture_limits();

/// The size that is wanted, or the largest of its shape within the limits. Not empty.
glm::uvec2 fitted(glm::uvec2 wanted, const PictureLimits& limits);

}  // namespace raybundle
