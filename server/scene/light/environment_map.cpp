// SPDX-License-Identifier: Apache-2.0
#include "scene/light/environment_map.h"

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
    : pixels_(std::make_shared<Pixels>()), settings_(settings) {
    pixels_->image = std::move(image);
    for (glm::vec3& pixel : pixels_->image.pixels) {
        pixel *= static_cast<float>(settings.scale);
    }
    take_sources();
    for (int y = 0; y < pixels_->image.height; ++y) {
        glm::dvec3 row(0.0);
        for (int x = 0; x < pixels_->image.width; ++x) {
            row += glm::dvec3(pixels_->sky()[pixels_->image.index(x, y)]);
        }
        pixels_->mean += row * (solid_angle(y) / (4.0 * pi));
    }
    mean_ = pixels_->mean;
    sources_ = pixels_->sources;
}

bool EnvironmentMap::same_shape(const Environment& other) const {
    const auto* const map = dynamic_cast<const EnvironmentMap*>(&other);
    return map != nullptr && map->pixels_ == pixels_;
}

std::shared_ptr<const Environment> EnvironmentMap::dimmed(
    const glm::dvec3& sky, std::span<const glm::dvec3> sources) const {
    auto copy = std::make_shared<EnvironmentMap>(*this);
    copy->sky_ = sky;
    copy->mean_ = sky * pixels_->mean;
    copy->sources_ = pixels_->sources;
    copy->source_factors_.assign(sources.begin(), sources.end());
    for (std::size_t i = 0; i < std::min(sources.size(), copy->sources_.size()); ++i) {
        copy->sources_[i].illuminance *= glm::vec3(sources[i]);
    }
    return copy;
}

/// Of one pixel of a row, sr.
double EnvironmentMap::solid_angle(int y) const {
    return 2.0 * pi / pixels_->image.width *
           (std::cos(pi * y / pixels_->image.height) -
            std::cos(pi * (y + 1) / pixels_->image.height));
}

glm::dvec3 EnvironmentMap::pixel_direction(int x, int y) const {
    const double azimuth = 2.0 * pi * ((x + 0.5) / pixels_->image.width - 0.5) + settings_.rotation;
    const double elevation = pi * (0.5 - (y + 0.5) / pixels_->image.height);
    const double level = std::cos(elevation);
    return {level * std::sin(azimuth), std::sin(elevation), -level * std::cos(azimuth)};
}

/// Bilinear between the centres of pixels.
glm::dvec3 EnvironmentMap::look_up(const std::vector<glm::vec3>& pixels,
                                   const glm::dvec3& direction) const {
    const double azimuth = std::atan2(direction.x, -direction.z) - settings_.rotation;
    const double turns = azimuth / (2.0 * pi) + 0.5;
    const double u = (turns - std::floor(turns)) * pixels_->image.width - 0.5;
    const double v =
        std::acos(std::clamp(direction.y, -1.0, 1.0)) / pi * pixels_->image.height - 0.5;
    const int x = static_cast<int>(std::floor(u));
    const int y = static_cast<int>(std::floor(v));
    const auto pixel = [&](int column, int row) {
        const int wrapped = (column + pixels_->image.width) % pixels_->image.width;
        const int clamped = std::clamp(row, 0, pixels_->image.height - 1);
        return glm::dvec3(pixels[pixels_->image.index(wrapped, clamped)]);
    };
    const glm::dvec3 top = glm::mix(pixel(x, y), pixel(x + 1, y), u - x);
    const glm::dvec3 bottom = glm::mix(pixel(x, y + 1), pixel(x + 1, y + 1), u - x);
    return glm::mix(top, bottom, v - y);
}

glm::dvec3 EnvironmentMap::radiance(const glm::dvec3& direction) const {
    return sky_ * look_up(pixels_->sky(), direction);
}

/// Factor of the source nearest to a direction.
glm::dvec3 EnvironmentMap::source_share(const glm::dvec3& direction) const {
    glm::dvec3 share(1.0);
    double nearest = -2.0;
    for (std::size_t i = 0; i < std::min(source_factors_.size(), sources_.size()); ++i) {
        const double cosine = glm::dot(direction, sources_[i].direction);
        if (cosine > nearest) {
            nearest = cosine;
            share = source_factors_[i];
        }
    }
    return share;
}

glm::dvec3 EnvironmentMap::shown(const glm::dvec3& direction) const {
    const glm::dvec3 whole = look_up(pixels_->image.pixels, direction);
    if (source_factors_.empty()) {
        return sky_ * whole;
    }
    const glm::dvec3 sky = look_up(pixels_->sky(), direction);
    return sky_ * sky + source_share(direction) * (whole - sky);
}

/// Mean luminance over all directions, nothing counted as brighter than a limit.
double EnvironmentMap::mean_luminance(double limit) const {
    double mean = 0.0;
    for (int y = 0; y < pixels_->image.height; ++y) {
        for (int x = 0; x < pixels_->image.width; ++x) {
            const std::size_t index = pixels_->image.index(x, y);
            mean += solid_angle(y) / (4.0 * pi) *
                    std::min(luminance_of(pixels_->image.pixels[index]), limit);
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
    for (std::vector<int>& spot : bright_spots(pixels_->image, bright * mean)) {
        double angle = 0.0;
        double illuminance = 0.0;
        for (const int pixel : spot) {
            const double part = solid_angle(pixel / pixels_->image.width);
            angle += part;
            illuminance +=
                part * luminance_of(pixels_->image.pixels[static_cast<std::size_t>(pixel)]);
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
    if (pixels_->sourceless.empty()) {
        pixels_->sourceless = pixels_->image.pixels;
    }
    double angle = 0.0;
    glm::dvec3 illuminance(0.0);
    glm::dvec3 centre(0.0);
    for (const int pixel : spot) {
        const auto index = static_cast<std::size_t>(pixel);
        const double part = solid_angle(pixel / pixels_->image.width);
        const glm::vec3 left = glm::min(pixels_->image.pixels[index], limit);
        const glm::vec3 taken = pixels_->image.pixels[index] - left;
        pixels_->sourceless[index] = left;
        angle += part;
        illuminance += part * glm::dvec3(taken);
        centre += part * luminance_of(taken) *
                  pixel_direction(pixel % pixels_->image.width, pixel / pixels_->image.width);
    }
    if (glm::length(centre) > 0.0) {
        pixels_->sources.push_back({glm::normalize(centre), glm::vec3(illuminance),
                                    static_cast<float>(std::sqrt(angle / pi))});
    }
}

std::string EnvironmentMap::description() const {
    std::string text =
        fmt::format("image '{}' of {} x {} pixels, {:.4g} cd/m² on average", settings_.name,
                    pixels_->image.width, pixels_->image.height, luminance_of(glm::vec3(mean_)));
    if (!sources_.empty()) {
        text += fmt::format("; {} bright spot{} as lights", sources_.size(),
                            sources_.size() == 1 ? "" : "s");
    }
    return text;
}

}  // namespace raybundle
