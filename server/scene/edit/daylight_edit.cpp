// SPDX-License-Identifier: Apache-2.0
#include "scene/edit/daylight_edit.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "scene/light/daylight.h"
#include "scene/light/environment.h"
#include "scene/light/sky_dome.h"

namespace raybundle {
namespace {

std::shared_ptr<const Environment> dark_sky() {
    SkyDomeSettings settings;
    settings.keeps_sun = true;
    return std::make_shared<const SkyDome>(settings);
}

Daylight named_daylight(const DaylightSetting& setting) {
    Daylight daylight;
    daylight.sky = setting.sky;
    daylight.sun_elevation = setting.sun_elevation;
    daylight.sun_azimuth = setting.sun_azimuth;
    daylight.zenith_luminance = setting.zenith_luminance;
    daylight.sun_illuminance = setting.sun_illuminance;
    daylight.turbidity = setting.turbidity;
    return daylight;
}

/// What the file gives the scene, without what has been dimmed since.
Sky undimmed(const Scene& scene) {
    Sky sky{scene.sky_light ? scene.sky_light->uniform : scene.sky_radiance, scene.environment};
    if (sky.environment) {
        const std::vector<glm::dvec3> ones(sky.environment->sources().size(), glm::dvec3(1.0));
        sky.environment = sky.environment->dimmed(glm::dvec3(1.0), ones);
    }
    return sky;
}

std::shared_ptr<const Environment> environment_of(const DaylightSetting& setting,
                                                  const Scene& scene) {
    if (setting.sky == DaylightSetting::loaded) {
        return scene.loaded_sky->environment ? scene.loaded_sky->environment : dark_sky();
    }
    const bool dark = setting.sky == DaylightSetting::none || setting.sun_elevation <= 0.0F;
    return dark ? dark_sky() : make_sky_dome(named_daylight(setting), scene.path, true);
}

}  // namespace

std::string problem_of(const DaylightSetting& daylight) {
    const bool known = daylight.sky == DaylightSetting::loaded ||
                       daylight.sky == DaylightSetting::none || cie_sky_type(daylight.sky) != 0;
    return known ? "" : "'" + daylight.sky + "' is none of none, loaded, " + cie_sky_names();
}

void apply(Scene& scene, const DaylightSetting& daylight) {
    if (!scene.loaded_sky) {
        scene.loaded_sky = std::make_shared<const Sky>(undimmed(scene));
    }
    scene.sky_radiance =
        daylight.sky == DaylightSetting::loaded ? scene.loaded_sky->uniform : glm::vec3(0.0F);
    set_environment(environment_of(daylight, scene), scene);
    SkyLight dark;
    dark.in_lux = true;
    dark.uniform = scene.sky_radiance;
    scene.sky_light = find_sky_light(scene).value_or(dark);
    scene.daylight = daylight;
}

bool daylight_dimmed(const Scene& scene) {
    const auto& lights = scene.punctual_lights;
    return (scene.sky_light &&
            (!scene.sky_light->on || scene.sky_light->intensity != scene.sky_light->loaded)) ||
           std::any_of(lights.begin(), lights.end(), [](const PunctualLight& light) {
               return light.of_sky && light.intensity != setting_of(light).loaded;
           });
}

}  // namespace raybundle
