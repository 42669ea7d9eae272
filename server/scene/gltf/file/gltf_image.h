// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/gltf/file/gltf_document.h"

namespace raybundle {

/// Decoded image, RGBA, 8 bits a channel, first row on top.
struct DecodedImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Name and place (buffer view or URI) of every entry of the JSON array "images"; those without a
/// name get their JSON path. Throws SceneError if the bytes do not exist.
std::vector<tinygltf::Image> read_images(const std::string& file, const Json& json);

/// Adds up what the images of all materials take once decoded, by their headers, so that nothing is
/// decoded of a file that goes beyond the limit. Throws SceneError. Left out: images in files of
/// their own, which decode_image() counts.
void check_image_sizes(const GltfDocument& document);

/// Decodes an entry of "images": PNG, JPEG or WebP, by content. Throws SceneError; KTX2 is refused
/// by the name of its extension.
DecodedImage decode_image(const GltfDocument& document, int image);

/// Index of the image to decode for a texture, -1 if it has none. Throws SceneError for KTX2
/// without fallback.
int image_of(const GltfDocument& document, int texture);

/// Mean of a channel of an extension's texture over all its texels, 0 to 1, with a notice; 1
/// without one that can be read. what: has such textures, for the notice.
float mean_of_channel(GltfDocument& document, const tinygltf::Value& extension, const char* name,
                      std::size_t channel, const std::string& what);

}  // namespace raybundle
