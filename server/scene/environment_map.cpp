// SPDX-License-Identifier: Apache-2.0
#include "scene/environment_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace raybundle {
namespace {

using std::numbers::pi;
/// Pixels this many times brighter than the mean may be part of a source.
constexpr double bright = 30.0;
/// Sources are at most this wide, radians: the shadows of wider ones are better found at random.
constexpr double widest_source = 0.0873;
constexpr std::size_t most_sources = 8;
/// A source gives at least this share of what the whole image does to a surface that faces it.
constexpr double least_share = 0.01;

double luminance_of(const glm::vec3& colour) {
    return static_cast<double>(luminance(colour));
}

/// Pixels of each connected spot that is brighter than a limit; the image closes at its sides.
std::vector<std::vector<int>> bright_spots(const EquirectangularImage& image, double limit) {
    std::vector<bool> seen(image.pixels.size(), false);
    std::vector<std::vector<int>> spots;
    const auto visit = [&](int x, int y, std::vector<int>& spot) {
        if (y < 0 || y >= image.height) {
            return;
        }
        const int pixel = y * image.width + (x + image.width) % image.width;
        const auto index = static_cast<std::size_t>(pixel);
        if (!seen[index] && luminance_of(image.pixels[index]) > limit) {
            seen[index] = true;
            spot.push_back(pixel);
        }
    };
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            std::vector<int> spot;
            visit(x, y, spot);
            for (std::size_t next = 0; next < spot.size(); ++next) {
                const int at_x = spot[next] % image.width;
                const int at_y = spot[next] / image.width;
                for (int k = 0; k < 9; ++k) {
                    visit(at_x + k % 3 - 1, at_y + k / 3 - 1, spot);
                }
            }
            if (!spot.empty()) {
                spots.push_back(std::move(spot));
            }
        }
    }
    return spots;
}

}  // namespace

EnvironmentMap::EnvironmentMap(EquirectangularImage image, const EnvironmentMapSettings& settings)
    : image_(std::move(image)), settings_(settings) {
    for (glm::vec3& pixel : image_.pixels) {
        pixel *= static_cast<float>(settings.scale);
    }
    take_sources();
    const std::vector<glm::vec3>& left = dimmed_.empty() ? image_.pixels : dimmed_;
    for (int y = 0; y < image_.height; ++y) {
        glm::dvec3 row(0.0);
        for (int x = 0; x < image_.width; ++x) {
            row += glm::dvec3(left[image_.index(x, y)]);
        }
        mean_ += row * (solid_angle(y) / (4.0 * pi));
    }
}

/// Of one pixel of a row, sr.
double EnvironmentMap::solid_angle(int y) const {
    return 2.0 * pi / image_.width *
           (std::cos(pi * y / image_.height) - std::cos(pi * (y + 1) / image_.height));
}

glm::dvec3 EnvironmentMap::pixel_direction(int x, int y) const {
    const double azimuth = 2.0 * pi * ((x + 0.5) / image_.width - 0.5) + settings_.rotation;
    const double elevation = pi * (0.5 - (y + 0.5) / image_.height);
    const double level = std::cos(elevation);
    return {level * std::sin(azimuth), std::sin(elevation), -level * std::cos(azimuth)};
}

/// Bilinear between the centres of pixels.
glm::dvec3 EnvironmentMap::look_up(const std::vector<glm::vec3>& pixels,
                                   const glm::dvec3& direction) const {
    const double azimuth = std::atan2(direction.x, -direction.z) - settings_.rotation;
    const double turns = azimuth / (2.0 * pi) + 0.5;
    const double u = (turns - std::floor(turns)) * image_.width - 0.5;
    const double v = std::acos(std::clamp(direction.y, -1.0, 1.0)) / pi * image_.height - 0.5;
    const int x = static_cast<int>(std::floor(u));
    const int y = static_cast<int>(std::floor(v));
    const auto pixel = [&](int column, int row) {
        const int wrapped = (column + image_.width) % image_.width;
        const int clamped = std::clamp(row, 0, image_.height - 1);
        return glm::dvec3(pixels[image_.index(wrapped, clamped)]);
    };
    const glm::dvec3 top = glm::mix(pixel(x, y), pixel(x + 1, y), u - x);
    const glm::dvec3 bottom = glm::mix(pixel(x, y + 1), pixel(x + 1, y + 1), u - x);
    return glm::mix(top, bottom, v - y);
}

glm::dvec3 EnvironmentMap::radiance(const glm::dvec3& direction) const {
    return look_up(dimmed_.empty() ? image_.pixels : dimmed_, direction);
}

glm::dvec3 EnvironmentMap::shown(const glm::dvec3& direction) const {
    return look_up(image_.pixels, direction);
}

/// Mean luminance over all directions, nothing counted as brighter than a limit.
double EnvironmentMap::mean_luminance(double limit) const {
    double mean = 0.0;
    for (int y = 0; y < image_.height; ++y) {
        for (int x = 0; x < image_.width; ++x) {
            const std::size_t index = image_.index(x, y);
            mean +=
                solid_angle(y) / (4.0 * pi) * std::min(luminance_of(image_.pixels[index]), limit);
        }
    }
    return mean;
}

void EnvironmentMap::take_sources() {
    double mean = mean_luminance(std::numeric_limits<double>::max());
    for (int i = 0; i < 4; ++i) {  // until a sun does not count in its own mean
        mean = mean_luminance(bright * mean);
    }
    std::vector<std::pair<double, std::vector<int>>> spots;
    for (std::vector<int>& spot : bright_spots(image_, bright * mean)) {
        double angle = 0.0;
        double illuminance = 0.0;
        for (const int pixel : spot) {
            const double part = solid_angle(pixel / image_.width);
            angle += part;
            illuminance += part * luminance_of(image_.pixels[static_cast<std::size_t>(pixel)]);
        }
        const bool small = angle < pi * widest_source * widest_source;
        if (small && illuminance > least_share * pi * mean) {
            spots.emplace_back(illuminance, std::move(spot));
        }
    }
    std::sort(spots.begin(), spots.end(), std::greater<>());
    for (std::size_t i = 0; i < std::min(spots.size(), most_sources); ++i) {
        take_source(spots[i].second, glm::vec3(static_cast<float>(bright * mean)));
    }
}

/// Makes a spot of the image a source, and puts no more than a limit in its place.
void EnvironmentMap::take_source(std::span<const int> spot, const glm::vec3& limit) {
    if (dimmed_.empty()) {
        dimmed_ = image_.pixels;
    }
    double angle = 0.0;
    glm::dvec3 illuminance(0.0);
    glm::dvec3 centre(0.0);
    for (const int pixel : spot) {
        const auto index = static_cast<std::size_t>(pixel);
        const double part = solid_angle(pixel / image_.width);
        const glm::vec3 left = glm::min(image_.pixels[index], limit);
        const glm::vec3 taken = image_.pixels[index] - left;
        dimmed_[index] = left;
        angle += part;
        illuminance += part * glm::dvec3(taken);
        centre += part * luminance_of(taken) *
                  pixel_direction(pixel % image_.width, pixel / image_.width);
    }
    if (glm::length(centre) > 0.0) {
        sources_.push_back({glm::normalize(centre), glm::vec3(illuminance),
                            static_cast<float>(std::sqrt(angle / pi))});
    }
}

std::string EnvironmentMap::description() const {
    std::string text =
        fmt::format("image '{}' of {} x {} pixels, {:.4g} cd/m² on average", settings_.name,
                    image_.width, image_.height, luminance_of(glm::vec3(mean_)));
    if (!sources_.empty()) {
        text += fmt::format("; {} bright spot{} as lights", sources_.size(),
                            sources_.size() == 1 ? "" : "s");
    }
    return text;
}

}  // namespace raybundle
