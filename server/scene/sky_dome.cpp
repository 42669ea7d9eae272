// SPDX-License-Identifier: Apache-2.0
#include "scene/sky_dome.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace raybundle {
namespace {

using std::numbers::pi;

/// Mean of a sky's relative luminance over the upper hemisphere.
double mean_relative_luminance(const CieSky& sky, const glm::dvec3& sun) {
    constexpr int sines = 128;
    constexpr int azimuths = 256;
    double sum = 0.0;
    for (int i = 0; i < sines; ++i) {
        const double elevation = std::asin((i + 0.5) / sines);
        for (int k = 0; k < azimuths; ++k) {
            sum += sky.relative_luminance(sky_direction(elevation, 2.0 * pi * (k + 0.5) / azimuths),
                                          sun);
        }
    }
    return sum / (double{sines} * azimuths);
}

}  // namespace

double typical_zenith_luminance(const CieSky& sky, double sun_elevation) {
    return sky.typical_illuminance() * std::sin(sun_elevation) /
           sky.relative_illuminance(sky_direction(sun_elevation, 0.0));
}

SkyDome::SkyDome(const SkyDomeSettings& settings)
    : settings_(settings),
      sun_(sky_direction(settings.sun_elevation, settings.sun_azimuth)),
      sky_illuminance_(settings.zenith_luminance * settings.sky.relative_illuminance(sun_)),
      ground_luminance_(settings.ground_albedo / pi *
                        (sky_illuminance_ + settings.sun_illuminance * sun_.y)),
      mean_(0.5 * (settings.zenith_luminance * mean_relative_luminance(settings.sky, sun_) +
                   ground_luminance_)) {
    if (settings.sun_illuminance > 0.0) {
        sources_.push_back({sun_, glm::vec3(static_cast<float>(settings.sun_illuminance)),
                            static_cast<float>(settings.sun_radius)});
    }
}

glm::dvec3 SkyDome::radiance(const glm::dvec3& direction) const {
    return glm::dvec3(direction.y < 0.0 ? ground_luminance_
                                        : settings_.zenith_luminance *
                                              settings_.sky.relative_luminance(direction, sun_));
}

glm::dvec3 SkyDome::shown(const glm::dvec3& direction) const {
    glm::dvec3 sum = radiance(direction);
    for (const SkySource& source : sources_) {
        const double radius = std::max(static_cast<double>(source.angular_radius), 1e-4);
        if (direction.y >= 0.0 && glm::dot(direction, source.direction) > std::cos(radius)) {
            sum += glm::dvec3(source.illuminance) / (pi * std::sin(radius) * std::sin(radius));
        }
    }
    return sum;
}

std::string SkyDome::description() const {
    const std::string type = settings_.sky.type == CieSky::traditional_overcast
                                 ? "CIE overcast sky"
                                 : fmt::format("CIE sky of type {}", settings_.sky.type);
    std::string text = fmt::format("{}, {:.4g} cd/m² in the zenith, {:.4g} lx", type,
                                   settings_.zenith_luminance, sky_illuminance_);
    if (!sources_.empty()) {
        text += fmt::format("; sun {:.4g} degrees high, {:.4g} lx facing it",
                            glm::degrees(settings_.sun_elevation), settings_.sun_illuminance);
    }
    return text;
}

}  // namespace raybundle
