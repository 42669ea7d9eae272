// SPDX-License-Identifier: Apache-2.0
#include "session/messages/daylight_messages.h"

#include <cmath>

#include "scene/edit/daylight_edit.h"
#include "scene/light/sun_position.h"
#include "session/messages/light_messages.h"

namespace raybundle {
namespace {

template <class T, class Message>
std::optional<T> given(bool has, Message value) {
    return has ? std::optional<T>(value) : std::nullopt;
}

/// From 0 to below 360.
float full_circle(double degrees) {
    const double turned = std::fmod(degrees, 360.0);
    return static_cast<float>(turned < 0.0 ? turned + 360.0 : turned);
}

void place_sun(v1::SetDaylight& daylight) {
    const std::optional<double> time = parse_time(daylight.time());
    if (!time || !daylight.has_place()) {
        return;
    }
    const SunPosition sun = sun_position(double{daylight.place().latitude()},
                                         double{daylight.place().longitude()}, *time);
    daylight.set_sun_elevation(static_cast<float>(sun.elevation));
    daylight.set_sun_azimuth(full_circle(sun.azimuth + double{daylight.north()}));
}

}  // namespace

DaylightSetting from_message(const v1::SetDaylight& daylight) {
    DaylightSetting setting;
    setting.sky = daylight.sky();
    if (daylight.has_sun_elevation()) {
        setting.sun_elevation = daylight.sun_elevation();
    }
    if (daylight.has_sun_azimuth()) {
        setting.sun_azimuth = daylight.sun_azimuth();
    }
    setting.zenith_luminance =
        given<float>(daylight.has_zenith_luminance(), daylight.zenith_luminance());
    setting.sun_illuminance =
        given<float>(daylight.has_sun_illuminance(), daylight.sun_illuminance());
    setting.turbidity = given<float>(daylight.has_turbidity(), daylight.turbidity());
    if (daylight.has_place()) {
        setting.place = glm::vec2(daylight.place().latitude(), daylight.place().longitude());
    }
    setting.north = daylight.north();
    setting.time = daylight.time();
    return setting;
}

v1::SetDaylight resolved(const Scene& scene, const v1::SetDaylight& daylight) {
    const v1::SetDaylight before = state_of_daylight(scene);
    v1::SetDaylight result = daylight;
    const bool angles = daylight.has_sun_elevation() || daylight.has_sun_azimuth();
    if (daylight.sky().empty()) {
        result.set_sky(before.sky() == DaylightSetting::loaded ? "clear" : before.sky());
    }
    if (!daylight.has_north() && before.has_north()) {
        result.set_north(before.north());
    }
    if (!angles && !daylight.has_place() && before.has_place()) {
        *result.mutable_place() = before.place();
    }
    if (!angles && daylight.time().empty()) {
        result.set_time(before.time());
    }
    if (!daylight.has_sun_elevation()) {
        result.set_sun_elevation(before.sun_elevation());
    }
    if (!daylight.has_sun_azimuth()) {
        result.set_sun_azimuth(before.sun_azimuth());
    }
    place_sun(result);
    return result;
}

std::string problem_of(const Scene& scene, const v1::SetDaylight& daylight) {
    if (!daylight.time().empty() && !parse_time(daylight.time())) {
        return "time: '" + daylight.time() + "' is not like 2026-06-21T15:00:00+02:00";
    }
    if (!daylight.time().empty() && !daylight.has_place() && !scene.daylight.place) {
        return "place: is missing: a time alone does not say where the sun stands";
    }
    const std::string problem = problem_of(from_message(resolved(scene, daylight)));
    return problem.empty() ? "" : "sky: " + problem;
}

v1::SetDaylight state_of_daylight(const Scene& scene) {
    const DaylightSetting& setting = scene.daylight;
    v1::SetDaylight state;
    state.set_sky(setting.sky);
    state.set_sun_elevation(setting.sun_elevation);
    state.set_sun_azimuth(setting.sun_azimuth);
    if (setting.zenith_luminance) {
        state.set_zenith_luminance(*setting.zenith_luminance);
    }
    if (setting.sun_illuminance) {
        state.set_sun_illuminance(*setting.sun_illuminance);
    }
    if (setting.turbidity) {
        state.set_turbidity(*setting.turbidity);
    }
    if (setting.place) {
        state.mutable_place()->set_latitude(setting.place->x);
        state.mutable_place()->set_longitude(setting.place->y);
    }
    state.set_north(setting.north);
    state.set_time(setting.time);
    return state;
}

void describe_sky_lights(const Scene& scene, v1::SetDaylight* message) {
    auto first = static_cast<std::uint32_t>(scene.lights.size()) + 1;
    for (const PunctualLight& light : scene.punctual_lights) {
        first += light.added || light.of_sky ? 0 : 1;
    }
    v1::Scene all;
    describe_lights(scene, &all);
    for (const v1::Light& light : all.lights()) {
        if (light.id() >= first) {
            *message->add_lights() = light;
        }
    }
}

}  // namespace raybundle
