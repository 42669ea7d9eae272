// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/scene.h"

namespace raybundle {

/// An encoded picture.
struct TextureImage {
    std::string bytes;
    bool png = false;  ///< else JPEG
    int width = 0, height = 0;
};

/// A texture of colours for a browser: halved until it is no larger than `most` texels along each
/// edge, by means of light. PNG where its alpha counts. Throws std::runtime_error.
TextureImage texture_image(const Texture& texture, bool with_alpha, int most);

}  // namespace raybundle
