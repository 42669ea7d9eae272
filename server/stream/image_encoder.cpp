// SPDX-License-Identifier: Apache-2.0
#include "stream/image_encoder.h"

#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace raybundle {
namespace {

constexpr std::size_t kBytesPerPixel = 4;

std::size_t stride_of(const PixelView& pixels) {
    return static_cast<std::size_t>(pixels.width) * kBytesPerPixel;
}

/// Rows from the top, three bytes a pixel: libpng's simplified interface cannot skip the fourth.
std::vector<std::uint8_t> pack_rgb(const PixelView& pixels) {
    std::vector<std::uint8_t> rgb;
    const auto width = static_cast<std::size_t>(pixels.width);
    const auto height = static_cast<std::size_t>(pixels.height);
    rgb.resize(width * height * 3);
    auto* out = rgb.data();
    for (std::size_t y = 0; y < height; ++y) {
        const std::size_t row = pixels.bottom_up ? height - 1 - y : y;
        const std::uint8_t* in = pixels.rgbx.data() + row * stride_of(pixels);
        for (std::size_t x = 0; x < width; ++x, in += kBytesPerPixel) {
            out = std::copy_n(in, 3, out);
        }
    }
    return rgb;
}

}  // namespace

void check_size(const PixelView& pixels) {
    const bool positive = pixels.width > 0 && pixels.height > 0;
    if (!positive ||
        pixels.rgbx.size() < stride_of(pixels) * static_cast<std::size_t>(pixels.height)) {
        throw std::runtime_error("picture of " + std::to_string(pixels.width) + "x" +
                                 std::to_string(pixels.height) + " pixels has only " +
                                 std::to_string(pixels.rgbx.size()) + " bytes");
    }
}

JpegEncoder::JpegEncoder() : compressor_(tjInitCompress()) {
    if (compressor_ == nullptr) {
        throw std::runtime_error(std::string("libjpeg-turbo: ") + tjGetErrorStr2(nullptr));
    }
}

JpegEncoder::~JpegEncoder() {
    tjDestroy(compressor_);
}

std::vector<std::uint8_t> JpegEncoder::encode(const PixelView& pixels, int quality,
                                              ChromaSampling chroma) {
    check_size(pixels);
    const int sampling = chroma == ChromaSampling::full ? TJSAMP_444 : TJSAMP_420;
    unsigned long size = tjBufSize(pixels.width, pixels.height, sampling);
    std::vector<std::uint8_t> jpeg(size);
    unsigned char* out = jpeg.data();
    const int flags = TJFLAG_FASTDCT | TJFLAG_NOREALLOC | (pixels.bottom_up ? TJFLAG_BOTTOMUP : 0);
    const int failed = tjCompress2(compressor_, pixels.rgbx.data(), pixels.width,
                                   static_cast<int>(stride_of(pixels)), pixels.height, TJPF_RGBX,
                                   &out, &size, sampling, quality, flags);
    if (failed != 0) {
        throw std::runtime_error(std::string("libjpeg-turbo: ") + tjGetErrorStr2(compressor_));
    }
    jpeg.resize(size);
    return jpeg;
}

std::vector<std::uint8_t> encode_png(const PixelView& pixels) {
    check_size(pixels);
    const std::vector<std::uint8_t> rgb = pack_rgb(pixels);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(pixels.width);
    image.height = static_cast<png_uint_32>(pixels.height);
    image.format = PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::uint8_t> png(size);
    const bool written =
        png_image_write_to_memory(&image, png.data(), &size, 0, rgb.data(), 0, nullptr) != 0;
    if (!written) {
        throw std::runtime_error(std::string("libpng: ") + image.message);
    }
    png.resize(size);
    return png;
}

}  // namespace raybundle
