// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/gltf_document.h"

namespace raybundle {

/// Decoded image, RGBA, 8 bits a channel, first row on top.
struct DecodedImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Makes sure that every entry of "images" names bytes that exist: a buffer view or a file.
void check_images(const GltfDocument& document);

/// Decodes an entry of "images": PNG, JPEG or WebP, by content. Throws SceneError; KTX2 is refused
/// by the name of its extension.
DecodedImage decode_image(const GltfDocument& document, int image);

}  // namespace raybundle
