// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/texture_images.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "solution/geometry/texture_levels.h"
#include "stream/image_encoder.h"

namespace raybundle {

namespace {

constexpr int jpeg_quality = 90;  // as pictures at rest are sent

std::string rgba_png(std::span<const std::uint8_t> rgba, int width, int height) {
    OIIO::ImageSpec spec(width, height, 4, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("png", &memory);
    if (!output || !output->open("texture.png", spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, rgba.data()) || !output->close()) {
        throw std::runtime_error("PNG: " + (output ? output->geterror() : OIIO::geterror()));
    }
    return {bytes.begin(), bytes.end()};
}

/// Texels of the level that is small enough; sets its size.
std::span<const std::uint8_t> reduced(const Texture& texture, int most,
                                      std::vector<std::uint32_t>& texels, TextureImage& image) {
    image.width = texture.width;
    image.height = texture.height;
    if (std::max(image.width, image.height) <= most) {
        return texture.rgba;
    }
    append_colour_levels(texture, texels);
    std::size_t first = 0;
    while (std::max(image.width, image.height) > most) {
        first += static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
        image.width = std::max(image.width / 2, 1);
        image.height = std::max(image.height / 2, 1);
    }
    const auto count =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    return {reinterpret_cast<const std::uint8_t*>(texels.data() + first), 4 * count};
}

}  // namespace

TextureImage texture_image(const Texture& texture, bool with_alpha, int most) {
    TextureImage image;
    image.png = with_alpha;
    std::vector<std::uint32_t> texels;
    const std::span<const std::uint8_t> rgba = reduced(texture, most, texels, image);
    if (with_alpha) {
        image.bytes = rgba_png(rgba, image.width, image.height);
        return image;
    }
    JpegEncoder encoder;
    const std::vector<std::uint8_t> bytes = encoder.encode({rgba, image.width, image.height, false},
                                                           jpeg_quality, ChromaSampling::full);
    image.bytes.assign(bytes.begin(), bytes.end());
    return image;
}

}  // namespace raybundle
