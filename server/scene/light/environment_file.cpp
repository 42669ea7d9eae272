// SPDX-License-Identifier: Apache-2.0
// Images of the surroundings: their layout, and what they have instead of numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "scene/gltf/gltf_loader.h"
#include "scene/light/environment_map.h"
#include "scene/light/picture_file.h"
#include "scene/other_file.h"

namespace raybundle {
namespace {

constexpr int max_width = 2048;  // of what is kept; larger images are averaged down
constexpr float largest_value = 1e12F;

[[noreturn]] void fail(const std::string& file, const std::string& reason) {
    throw SceneError(file, "", reason);
}

bool has_magic(std::span<const std::uint8_t> bytes, const char* magic) {
    const std::size_t length = std::strlen(magic);
    return bytes.size() >= length && std::memcmp(bytes.data(), magic, length) == 0;
}

/// Averages blocks of k x k pixels; what is left at the right and below is dropped.
EquirectangularImage reduced(const EquirectangularImage& image, int k) {
    EquirectangularImage small{image.width / k, image.height / k, {}, image.notes};
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

/// Refuses other layouts than equirectangular ones. Limits are half way (as factors) to the next
/// layouts: 3:2, six faces in two rows, and 4:1, half a panorama.
void check_layout(const std::string& file, EquirectangularImage& image) {
    const double ratio = static_cast<double>(image.width) / image.height;
    if (ratio < std::sqrt(2.0 * 1.5) || ratio > std::sqrt(2.0 * 4.0)) {
        const bool cube = image.width == 6 * image.height || image.height == 6 * image.width ||
                          3 * image.width == 4 * image.height ||
                          4 * image.width == 3 * image.height;
        const char* kind = image.width == image.height ? " (as angular maps and light probes have)"
                                                       : (cube ? " (as cube maps have)" : "");
        fail(file, fmt::format("has {} x {} pixels{}: an equirectangular image is twice as wide as "
                               "high",
                               image.width, image.height, kind));
    }
    constexpr int rounding = 2;
    if (std::abs(image.width - 2 * image.height) > rounding) {
        image.notes.push_back(fmt::format("has {} x {} pixels: stretched to twice as wide as high",
                                          image.width, image.height));
    }
}

enum class Number { finite, infinite, unknown };

/// Values that no scene has count as infinite.
Number kind_of(const glm::vec3& pixel) {
    Number kind = Number::finite;
    for (int c = 0; c < 3; ++c) {
        if (!(pixel[c] >= -largest_value)) {
            return Number::unknown;
        }
        kind = pixel[c] > largest_value ? Number::infinite : kind;
    }
    return kind;
}

/// Mean of the neighbours that are finite; the image closes at its sides.
glm::vec3 mean_of_neighbours(const EquirectangularImage& image, std::size_t pixel) {
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(image.width));
    const int y = static_cast<int>(pixel / static_cast<std::size_t>(image.width));
    glm::vec3 sum(0.0F);
    float count = 0.0F;
    for (int k = 0; k < 9; ++k) {
        const int row = y + k / 3 - 1;
        if (row < 0 || row >= image.height) {
            continue;
        }
        const int column = (x + k % 3 - 1 + image.width) % image.width;
        const glm::vec3& other = image.pixels[image.index(column, row)];
        if (kind_of(other) == Number::finite) {
            sum += other;
            count += 1.0F;
        }
    }
    return count > 0.0F ? sum / count : glm::vec3(0.0F);
}

/// What is no number becomes the mean of its neighbours.
void mend_unknown(EquirectangularImage& image) {
    std::vector<std::pair<std::size_t, glm::vec3>> mended;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (kind_of(image.pixels[i]) == Number::unknown) {
            mended.emplace_back(i, mean_of_neighbours(image, i));
        }
    }
    for (const auto& [pixel, mean] : mended) {
        image.pixels[pixel] = mean;
    }
    if (!mended.empty()) {
        image.notes.push_back(
            fmt::format("pixels without a number are read as their neighbours: {}", mended.size()));
    }
}

/// What is infinite, as a sun is in half floats, becomes the largest value that they can have, or
/// that the image has.
void mend_infinite(EquirectangularImage& image, float largest) {
    std::vector<glm::vec3*> mended;
    for (glm::vec3& pixel : image.pixels) {
        if (kind_of(pixel) == Number::infinite) {
            mended.push_back(&pixel);
        } else {
            largest = std::max({largest, pixel.r, pixel.g, pixel.b});
        }
    }
    for (glm::vec3* pixel : mended) {
        for (int c = 0; c < 3; ++c) {
            (*pixel)[c] = (*pixel)[c] > largest_value ? largest : (*pixel)[c];
        }
    }
    if (!mended.empty()) {
        image.notes.push_back(
            fmt::format("infinite pixels are read as {}: {}", largest, mended.size()));
    }
}

PictureFile read_picture(const std::string& file, std::span<const std::uint8_t> bytes) {
    if (has_magic(bytes, "#?")) {
        return read_radiance_picture(file, bytes);
    }
    if (has_magic(bytes, "\x76\x2f\x31\x01")) {
        return read_openexr_picture(file, bytes);
    }
    const std::string kind = other_file_kind(bytes);
    fail(file,
         "is neither a Radiance HDR nor an OpenEXR image" + (kind.empty() ? "" : ": " + kind));
}

}  // namespace

EquirectangularImage read_equirectangular(const std::string& file,
                                          std::span<const std::uint8_t> bytes) {
    PictureFile picture = read_picture(file, bytes);
    if (picture.width < 2 || picture.height < 1) {
        fail(file, fmt::format("has {} x {} pixels", picture.width, picture.height));
    }
    EquirectangularImage image{picture.width, picture.height, std::move(picture.pixels),
                               std::move(picture.notes)};
    check_layout(file, image);
    mend_unknown(image);
    mend_infinite(image, picture.largest);
    for (glm::vec3& pixel : image.pixels) {
        pixel = glm::max(glm::vec3(picture.rec709 * glm::dvec3(pixel)), 0.0F);
    }
    const int k = (image.width + max_width - 1) / max_width;
    return k > 1 ? reduced(image, std::min(k, image.height)) : image;
}

}  // namespace raybundle
