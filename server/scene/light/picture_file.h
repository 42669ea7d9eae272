// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace raybundle {

/// Pixels of an image file as they are stored, linear, top row first. Some may be infinite, or no
/// numbers.
struct PictureFile {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;  ///< width * height
    glm::dmat3 rec709{1.0};         ///< Rec. 709 of the file's colours
    float largest = 0.0F;           ///< largest number that half floats can be; 0: of other files
    std::vector<std::string> notes{};  ///< what a user should know about how it was read
};

/// Most pixels of an image that is read.
constexpr std::int64_t max_picture_pixels = 64LL << 20U;

/// Decodes a Radiance picture (.hdr, .pic): RGBE and XYZE, flat and with both kinds of run lengths,
/// in all eight orientations, divided by the products of EXPOSURE and of COLORCORR, with its
/// PRIMARIES. Throws SceneError naming `file`.
PictureFile read_radiance_picture(const std::string& file, std::span<const std::uint8_t> bytes);

/// Decodes an OpenEXR file: its channels R, G, B or Y where its display window is, with its
/// chromaticities. Refuses cube maps and deep images. Throws SceneError naming `file`.
PictureFile read_openexr_picture(const std::string& file, std::span<const std::uint8_t> bytes);

}  // namespace raybundle
