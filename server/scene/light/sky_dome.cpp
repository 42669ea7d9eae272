// SPDX-License-Identifier: Apache-2.0
#include "scene/light/sky_dome.h"

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
      mean_luminance_(settings.zenith_luminance * mean_relative_luminance(settings.sky, sun_)) {
    if (settings.sun_illuminance > 0.0 || settings.keeps_sun) {
        sources_.push_back({sun_, glm::vec3(0.0F), static_cast<float>(settings.sun_radius)});
    }
    set_light(glm::dvec3(1.0), glm::dvec3(1.0));
}

void SkyDome::set_light(const glm::dvec3& sky, const glm::dvec3& sun) {
    sky_ = sky;
    for (SkySource& source : sources_) {
        source.illuminance = glm::vec3(settings_.sun_illuminance * sun);
    }
    ground_ = settings_.ground_albedo / pi *
              (sky * sky_illuminance_ + sun * settings_.sun_illuminance * sun_.y);
    mean_ = 0.5 * (sky * mean_luminance_ + ground_);
}

std::shared_ptr<const Environment> SkyDome::dimmed(const glm::dvec3& sky,
                                                   std::span<const glm::dvec3> sources) const {
    auto copy = std::make_shared<SkyDome>(*this);
    copy->set_light(sky, sources.empty() ? glm::dvec3(1.0) : sources.front());
    return copy;
}

bool SkyDome::same_shape(const Environment& other) const {
    const auto* const dome = dynamic_cast<const SkyDome*>(&other);
    return dome != nullptr && dome->settings_.sky.type == settings_.sky.type && dome->sun_ == sun_;
}

glm::dvec3 SkyDome::radiance(const glm::dvec3& direction) const {
    return direction.y < 0.0 ? ground_
                             : sky_ * (settings_.zenith_luminance *
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
    if (settings_.sun_illuminance > 0.0) {
        text += fmt::format("; sun {:.4g} degrees high, {:.4g} lx facing it",
                            glm::degrees(settings_.sun_elevation), settings_.sun_illuminance);
    }
    return text;
}

}  // namespace raybundle
