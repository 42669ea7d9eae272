// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "scene/environment_map.h"
#include "scene/gltf_loader.h"

namespace raybundle {
namespace {

constexpr std::int64_t max_pixels = 64LL << 20U;
constexpr int max_width = 2048;  // of what is kept; larger images are averaged down
constexpr float largest_value = 1e12F;

[[noreturn]] void fail(const std::string& file, const std::string& reason) {
    throw SceneError(file, "", reason);
}

/// OpenImageIO's name of the format.
const char* format_of(std::span<const std::uint8_t> bytes) {
    const auto starts_with = [&](const char* magic) {
        const std::size_t length = std::strlen(magic);
        return bytes.size() >= length && std::memcmp(bytes.data(), magic, length) == 0;
    };
    if (starts_with("#?")) {
        return "hdr";
    }
    return starts_with("\x76\x2f\x31\x01") ? "openexr" : nullptr;
}

/// Averages blocks of k x k pixels; what is left at the right and below is dropped.
EquirectangularImage reduced(const EquirectangularImage& image, int k) {
    EquirectangularImage small{image.width / k, image.height / k, {}};
    small.pixels.reserve(static_cast<std::size_t>(small.width) *
                         static_cast<std::size_t>(small.height));
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            glm::vec3 sum(0.0F);
            for (int i = 0; i < k * k; ++i) {
                const int at = (k * y + i / k) * image.width + k * x + i % k;
                sum += image.pixels[static_cast<std::size_t>(at)];
            }
            small.pixels.push_back(sum / static_cast<float>(k * k));
        }
    }
    return small;
}

EquirectangularImage checked(const std::string& file, const std::vector<float>& values,
                             const OIIO::ImageSpec& spec) {
    EquirectangularImage image{spec.width, spec.height, {}};
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    image.pixels.reserve(values.size() / channels);
    for (std::size_t i = 0; i + channels <= values.size(); i += channels) {
        glm::vec3 pixel(values[i], values[i + (channels > 2 ? 1 : 0)],
                        values[i + (channels > 2 ? 2 : 0)]);
        for (int c = 0; c < 3; ++c) {
            if (!std::isfinite(pixel[c]) || pixel[c] > largest_value) {
                fail(file, fmt::format("pixel {}, {} is not a finite radiance",
                                       i / channels % static_cast<std::size_t>(spec.width),
                                       i / channels / static_cast<std::size_t>(spec.width)));
            }
        }
        image.pixels.push_back(glm::max(pixel, 0.0F));
    }
    return image;
}

}  // namespace

EquirectangularImage read_equirectangular(const std::string& file,
                                          std::span<const std::uint8_t> bytes) {
    const char* format = format_of(bytes);
    if (format == nullptr) {
        fail(file, "is neither a Radiance HDR nor an OpenEXR image");
    }
    OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
    OIIO::ImageSpec hints;
    OIIO::Filesystem::IOProxy* proxy = &reader;
    hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&proxy));
    const auto input = OIIO::ImageInput::open(std::string("image.") + format, &hints);
    if (!input) {
        fail(file, fmt::format("cannot be decoded: {}", OIIO::geterror()));
    }
    const OIIO::ImageSpec& spec = input->spec();
    const std::int64_t pixels = std::int64_t{spec.width} * spec.height;
    if (spec.width < 2 || spec.height < 1 || pixels > max_pixels || spec.nchannels < 1 ||
        spec.nchannels > 64) {
        fail(file, fmt::format("{} x {} pixels of {} channels; the limit is {} pixels", spec.width,
                               spec.height, spec.nchannels, max_pixels));
    }
    const int channels = spec.nchannels < 3 ? 1 : 3;
    OIIO::ImageSpec read = spec;
    read.nchannels = channels;
    std::vector<float> values(static_cast<std::size_t>(pixels) *
                              static_cast<std::size_t>(channels));
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data())) {
        fail(file, fmt::format("cannot be decoded: {}", input->geterror()));
    }
    EquirectangularImage image = checked(file, values, read);
    const int k = (image.width + max_width - 1) / max_width;
    return k > 1 ? reduced(image, std::min(k, image.height)) : image;
}

}  // namespace raybundle
