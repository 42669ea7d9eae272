// SPDX-License-Identifier: Apache-2.0
#include "view/image/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace raybundle {

namespace {

/// Writes to a temporary name beside the target, then renames.
template <typename Pixel>
void write_image(const std::string& path, const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type,
                 const std::vector<Pixel>& pixels) {
    namespace fs = std::filesystem;
    const fs::path target(path);
    const fs::path temporary = target.parent_path() / ("." + target.stem().string() + ".part" +
                                                       target.extension().string());
    const auto fail = [&](const std::string& reason) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw std::runtime_error(path + ": cannot be written: " + reason);
    };
    auto output = OIIO::ImageOutput::create(temporary.string());
    if (!output) {
        fail(OIIO::geterror());
    }
    if (!output->open(temporary.string(), spec) || !output->write_image(type, pixels.data()) ||
        !output->close()) {
        fail(output->geterror());
    }
    std::error_code error;
    fs::rename(temporary, target, error);
    if (error) {
        fail(error.message());
    }
}

std::vector<float> without_alpha(std::span<const glm::vec4> radiance) {
    std::vector<float> rgb;
    rgb.reserve(radiance.size() * 3);
    for (const glm::vec4& value : radiance) {
        rgb.insert(rgb.end(), {value.r, value.g, value.b});
    }
    return rgb;
}

OIIO::ImageSpec exr_spec(int width, int height) {
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    spec.attribute("Software", "Raybundle " RAYBUNDLE_VERSION);
    spec.attribute("comments", "linear radiance, cd/m^2, Rec. 709 primaries");
    return spec;
}

}  // namespace

void write_exr(const std::string& path, int width, int height,
               std::span<const glm::vec4> radiance) {
    write_image(path, exr_spec(width, height), OIIO::TypeDesc::FLOAT, without_alpha(radiance));
}

std::string exr_bytes(int width, int height, std::span<const glm::vec4> radiance) {
    const std::vector<float> rgb = without_alpha(radiance);
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("exr", &memory);
    if (!output || !output->open("picture.exr", exr_spec(width, height)) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, rgb.data()) || !output->close()) {
        throw std::runtime_error("EXR: " + (output ? output->geterror() : OIIO::geterror()));
    }
    return {bytes.begin(), bytes.end()};
}

void write_png(const std::string& path, int width, int height, std::span<const std::uint8_t> rgba) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
        rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    }
    const OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    write_image(path, spec, OIIO::TypeDesc::UINT8, rgb);
}

LinearPicture read_exr(const std::string& path) {
    constexpr int most_pixels_a_side = 16384;
    const auto fail = [&](const std::string& reason) {
        throw std::runtime_error(path + ": cannot be read: " + reason);
    };
    const auto input = OIIO::ImageInput::open(path);
    if (!input) {
        fail(OIIO::geterror());
    }
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.nchannels < 3 || spec.width < 1 || spec.height < 1 ||
        spec.width > most_pixels_a_side || spec.height > most_pixels_a_side) {
        fail("it is no RGB picture of up to 16384 x 16384 pixels");
    }
    LinearPicture picture{spec.width, spec.height, {}};
    picture.radiance.resize(static_cast<std::size_t>(spec.width) *
                            static_cast<std::size_t>(spec.height));
    if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, picture.radiance.data())) {
        fail(input->geterror());
    }
    return picture;
}

}  // namespace raybundle
