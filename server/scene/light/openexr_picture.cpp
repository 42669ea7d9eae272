// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "scene/gltf/gltf_loader.h"
#include "scene/light/picture_file.h"
#include "scene/material/colour_space.h"
#include "scene/other_file.h"

namespace raybundle {
namespace {

constexpr int max_channels = 64;
constexpr int max_parts = 64;
constexpr const char* no_light[] = {"Z", "ZBack", "depth", "A", "alpha"};
constexpr float largest_half = 65504.0F;

[[noreturn]] void fail_picture(const std::string& file, const std::string& reason) {
    throw SceneError(file, "", reason);
}

/// Whether a channel has another meaning than light: depth and coverage.
bool is_no_light(const std::string& name) {
    const std::string last = name.substr(name.rfind('.') + 1);
    return std::any_of(std::begin(no_light), std::end(no_light),
                       [&](const char* other) { return OIIO::Strutil::iequals(last, other); });
}

/// Channels of red, green and blue: R, G, B, else those of the first layer that has them, else Y
/// for all, else the only channel.
std::optional<std::array<int, 3>> colour_channels(const OIIO::ImageSpec& spec) {
    const std::vector<std::string>& names = spec.channelnames;
    constexpr std::array<std::array<const char*, 3>, 3> spellings = {
        {{"R", "G", "B"}, {"r", "g", "b"}, {"red", "green", "blue"}}};
    for (const auto& [red, green, blue] : spellings) {
        for (const std::string& name : names) {
            if (name != red && !name.ends_with(std::string(".") + red)) {
                continue;
            }
            const std::string layer = name.substr(0, name.size() - std::string_view(red).size());
            const int g = spec.channelindex(layer + green);
            const int b = spec.channelindex(layer + blue);
            if (g >= 0 && b >= 0) {
                return std::array<int, 3>{spec.channelindex(name), g, b};
            }
        }
    }
    const bool lone = spec.nchannels == 1 && !is_no_light(names[0]);
    const int grey = lone ? 0 : spec.channelindex("Y");
    const bool colour =  // of XYZ, or of luminance and chroma
        spec.channelindex("X") >= 0 || spec.channelindex("RY") >= 0;
    if (grey >= 0 && !colour) {
        return std::array<int, 3>{grey, grey, grey};
    }
    return std::nullopt;
}

void check_openexr(const std::string& file, const OIIO::ImageSpec& spec) {
    for (const auto& [width, height] :
         {std::pair(spec.width, spec.height), std::pair(spec.full_width, spec.full_height)}) {
        if (width < 1 || height < 1 || std::int64_t{width} * height > max_picture_pixels ||
            spec.nchannels < 1 || spec.nchannels > max_channels) {
            fail_picture(file, fmt::format("{} x {} pixels of {} channels; the limit is {} pixels",
                                           width, height, spec.nchannels, max_picture_pixels));
        }
    }
    if (spec.deep) {
        fail_picture(file, "is a deep image");
    }
    if (std::string(spec.get_string_attribute("textureformat")).starts_with("CubeFace")) {
        fail_picture(
            file,
            "is a cube map (its attribute envmap says so): only equirectangular images are "
            "read");
    }
}

std::optional<glm::dmat3> rec709_of(const OIIO::ImageSpec& spec) {
    std::array<float, 8> xy{};
    if (!spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), xy.data())) {
        return std::nullopt;
    }
    std::array<double, 8> exact{};
    std::copy(xy.begin(), xy.end(), exact.begin());
    return rec709_from_primaries(exact);
}

/// The part of the data window that is in the display window; black elsewhere.
PictureFile placed(const OIIO::ImageSpec& spec, const std::vector<float>& values, int first,
                   int channels, const std::array<int, 3>& colours) {
    PictureFile image{spec.full_width, spec.full_height, {}};
    image.pixels.resize(static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const int column = x + spec.full_x - spec.x;
            const int row = y + spec.full_y - spec.y;
            if (column < 0 || column >= spec.width || row < 0 || row >= spec.height) {
                continue;
            }
            const std::size_t at =
                (static_cast<std::size_t>(row) * static_cast<std::size_t>(spec.width) +
                 static_cast<std::size_t>(column)) *
                static_cast<std::size_t>(channels);
            glm::vec3& pixel =
                image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(x)];
            for (int c = 0; c < 3; ++c) {
                const int channel = colours[static_cast<std::size_t>(c)] - first;
                pixel[c] = values[at + static_cast<std::size_t>(channel)];
            }
        }
    }
    return image;
}

/// Makes the first part that has colours the input's own; its channels.
std::array<int, 3> seek_colours(const std::string& file, OIIO::ImageInput& input) {
    std::string list;
    for (int part = 0; part < max_parts && input.seek_subimage(part, 0); ++part) {
        const OIIO::ImageSpec& spec = input.spec();
        if (const auto colours = colour_channels(spec)) {
            check_openexr(file, spec);
            return *colours;
        }
        for (const std::string& name : spec.channelnames) {
            list += (list.empty() ? "" : ", ") + name;
        }
    }
    fail_picture(file, fmt::format("has no channels R, G and B, but {}", list.substr(0, 200)));
}

}  // namespace

PictureFile read_openexr_picture(const std::string& file, std::span<const std::uint8_t> bytes) {
    OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
    OIIO::ImageSpec hints;
    OIIO::Filesystem::IOProxy* proxy = &reader;
    hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&proxy));
    const auto input = OIIO::ImageInput::open("image.openexr", &hints);
    if (!input) {
        fail_picture(file, fmt::format("cannot be decoded: {}", plain_message(OIIO::geterror())));
    }
    const std::array<int, 3> colours = seek_colours(file, *input);
    const OIIO::ImageSpec& spec = input->spec();
    const auto [low, high] = std::minmax_element(colours.begin(), colours.end());
    const int first = *low;
    const int channels = *high - *low + 1;
    std::vector<float> values(static_cast<std::size_t>(spec.width) *
                              static_cast<std::size_t>(spec.height) *
                              static_cast<std::size_t>(channels));
    if (!input->read_image(input->current_subimage(), 0, first, first + channels,
                           OIIO::TypeDesc::FLOAT, values.data())) {
        fail_picture(file, fmt::format("cannot be decoded: {}", plain_message(input->geterror())));
    }
    PictureFile image = placed(spec, values, first, channels, colours);
    image.largest = spec.channelformat(first) == OIIO::TypeDesc::HALF ? largest_half : 0.0F;
    image.rec709 = rec709_of(spec).value_or(glm::dmat3(1.0));
    return image;
}

}  // namespace raybundle
