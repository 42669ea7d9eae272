// SPDX-License-Identifier: Apache-2.0
#include "scene/light/daylight.h"

#include <fmt/format.h>

#include <glm/gtc/constants.hpp>
#include <memory>
#include <utility>

#include "scene/gltf/gltf_loader.h"
#include "scene/light/environment_map.h"
#include "scene/light/sky_dome.h"

namespace raybundle {
namespace {

constexpr double sun_diameter = 0.533;  // degrees, on average over the year
/// Towards the zenith the typical luminance of most skies is not known (the sun is never there in
/// the data): below this the formulas hold, and clear skies want a sun above the horizon.
constexpr double lowest_sun = 1.0;

double radians_of(const std::optional<float>& degrees, double fallback) {
    return glm::radians(degrees ? static_cast<double>(*degrees) : fallback);
}

template <typename T>
void overlay(std::optional<T>& value, const std::optional<T>& more) {
    if (more) {
        value = more;
    }
}

std::shared_ptr<const Environment> make_map(const Daylight& daylight, Scene& scene) {
    EnvironmentMapSettings settings;
    settings.name = *daylight.environment;
    settings.rotation = radians_of(daylight.environment_rotation, 0.0);
    settings.scale =
        daylight.environment_scale ? static_cast<double>(*daylight.environment_scale) : 1.0;
    EquirectangularImage image = read_equirectangular(settings.name, daylight.environment_bytes);
    for (const std::string& note : image.notes) {
        scene.notices.push_back(fmt::format("image '{}': {}", settings.name, note));
    }
    return std::make_shared<const EnvironmentMap>(std::move(image), settings);
}

}  // namespace

std::shared_ptr<const Environment> make_sky_dome(const Daylight& daylight, const std::string& file,
                                                 bool keeps_sun) {
    SkyDomeSettings settings;
    settings.keeps_sun = keeps_sun;
    settings.sky.type = cie_sky_type(*daylight.sky);
    if (settings.sky.type == 0) {
        throw SceneError(file, "",
                         fmt::format("sky '{}' is none of {}", *daylight.sky, cie_sky_names()));
    }
    settings.sun_elevation = radians_of(daylight.sun_elevation, 45.0);
    settings.sun_azimuth = radians_of(daylight.sun_azimuth, 180.0);
    settings.sun_radius = 0.5 * radians_of(daylight.sun_diameter, sun_diameter);
    const double elevation = std::max(settings.sun_elevation, glm::radians(lowest_sun));
    settings.zenith_luminance = daylight.zenith_luminance
                                    ? static_cast<double>(*daylight.zenith_luminance)
                                    : typical_zenith_luminance(settings.sky, elevation);
    settings.sun_illuminance =
        daylight.sun_illuminance
            ? static_cast<double>(*daylight.sun_illuminance)
            : settings.sky.typical_sun_illuminance(elevation, daylight.turbidity);
    if (daylight.ground_albedo) {
        settings.ground_albedo = static_cast<double>(*daylight.ground_albedo);
    }
    return std::make_shared<const SkyDome>(settings);
}

Daylight overlaid(const Daylight& daylight, const Daylight& more) {
    Daylight result = daylight;
    if (more.given()) {
        result.sky = more.sky;
        result.environment = more.environment;
        result.environment_bytes = more.environment_bytes;
    }
    overlay(result.zenith_luminance, more.zenith_luminance);
    overlay(result.sun_elevation, more.sun_elevation);
    overlay(result.sun_azimuth, more.sun_azimuth);
    overlay(result.sun_illuminance, more.sun_illuminance);
    overlay(result.sun_diameter, more.sun_diameter);
    overlay(result.turbidity, more.turbidity);
    overlay(result.ground_albedo, more.ground_albedo);
    overlay(result.environment_rotation, more.environment_rotation);
    overlay(result.environment_scale, more.environment_scale);
    return result;
}

void apply_daylight(const Daylight& daylight, Scene& scene) {
    if (daylight.environment) {
        set_environment(make_map(daylight, scene), scene);
    } else if (daylight.sky) {
        set_environment(make_sky_dome(daylight, scene.path, false), scene);
    }
}

}  // namespace raybundle
