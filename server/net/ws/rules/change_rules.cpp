// SPDX-License-Identifier: Apache-2.0
#include "net/ws/rules/change_rules.h"

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "net/http/scene_name.h"
#include "net/ws/rules/addition_rules.h"

namespace raybundle {
namespace {

constexpr int kMaxGroupLights = 4096;
constexpr float kMaxCone = 90.0F;  ///< degrees
constexpr float kMinKelvin = 1000.0F;
constexpr float kMaxKelvin = 25000.0F;

/// Where a light is, how it is turned and how its beam is shaped.
void check_place(const v1::SetLight& light, MessageChecker& check) {
    if (light.has_aim()) {
        check.require(glm::length(to_vector(light.aim())) >= kMinLength, "setLight.aim",
                      "must not be zero");
    }
    check.require(std::abs(light.rotation()) <= kMaxTurn, "setLight.rotation",
                  "must be -360..360 degrees");
    const auto is_cone = [](float degrees) { return degrees >= 0.0F && degrees <= kMaxCone; };
    check.require(is_cone(light.inner_cone()), "setLight.innerCone", "must be 0..90 degrees");
    check.require(is_cone(light.outer_cone()), "setLight.outerCone", "must be 0..90 degrees");
    if (light.has_inner_cone() && light.has_outer_cone()) {
        check.require(light.inner_cone() <= light.outer_cone(), "setLight.innerCone",
                      "must not be wider than outerCone");
    }
}

/// What takes a while. field: its name.
void check_fade(float seconds, std::string_view field, MessageChecker& check) {
    check.require(seconds >= 0.0F && seconds <= max_fade_seconds, field, "must be 0..60 s");
}

/// Brightness, colour and switch fade; nothing else that stands beside them would.
void check_fade(const v1::SetLight& light, MessageChecker& check) {
    check_fade(light.fade_seconds(), "setLight.fadeSeconds", check);
    if (light.fade_seconds() > 0.0F) {
        const bool jumps = light.has_position() || light.has_aim() || light.has_rotation() ||
                           light.has_inner_cone() || light.has_outer_cone() ||
                           light.has_photometry();
        check.require(!jumps, "setLight.fadeSeconds",
                      "place, beam and photometry do not fade: needs a request of their own");
        const bool fades = light.has_intensity() || light.has_flux() || light.has_colour() ||
                           light.has_colour_temperature() || light.has_on() || light.has_dim();
        check.require(fades, "setLight.fadeSeconds",
                      "nothing fades: needs intensity, flux, colour, colourTemperature, on or dim");
    }
}

void check_scene_name(const std::string& name, std::string_view field, MessageChecker& check) {
    const std::size_t length = characters(name);
    check.require(length >= 1 && length <= kMaxName, field, "must be 1..64 characters");
}

}  // namespace

void check_body(const v1::MoveObject& move, MessageChecker& check) {
    check.require(move.object() >= 1, "moveObject.object", "is missing");
    check.require(move.has_transform(), "moveObject.transform", "is missing");
    check_transform(move.transform(), "moveObject.transform", check);
}

void check_body(const v1::SetLight& light, MessageChecker& check) {
    check.require(light.light() >= 1, "setLight.light", "is missing");
    v1::SetLight number;
    number.set_light(light.light());
    if (light.has_fade_seconds()) {
        number.set_fade_seconds(light.fade_seconds());
    }
    check.require(light.ByteSizeLong() > number.ByteSizeLong(), "setLight",
                  "changes nothing: needs intensity, on, colour or another field");
    check.require(light.intensity() >= 0.0F, "setLight.intensity", "must not be negative");
    check.require(light.flux() >= 0.0F, "setLight.flux", "must not be negative");
    check.require(!light.has_flux() || !light.has_intensity(), "setLight.flux",
                  "stands beside intensity: needs one of them");
    check.require(!light.has_colour_temperature() || !light.has_colour(),
                  "setLight.colourTemperature", "stands beside colour: needs one of them");
    if (light.has_colour_temperature()) {
        const float kelvin = light.colour_temperature();
        check.require(kelvin >= kMinKelvin && kelvin <= kMaxKelvin, "setLight.colourTemperature",
                      "must be 1000..25000 K");
    }
    if (light.has_colour()) {
        check.colour(light.colour(), static_cast<float>(kMaxNumber), "setLight.colour",
                     "must not be negative");
        check.require(glm::length(to_vector(light.colour())) >= kMinLength, "setLight.colour",
                      "must not be black");
    }
    check.share(light.dim(), "setLight.dim");
    if (light.has_maintenance_factor()) {
        const float factor = light.maintenance_factor();
        check.require(factor > 0.0F && factor <= 1.0F, "setLight.maintenanceFactor",
                      "must be above 0 and at most 1");
    }
    check.require(light.colour_rendering() >= 0.0F && light.colour_rendering() <= 100.0F,
                  "setLight.colourRendering", "must be 0..100");
    check.require(characters(light.group()) <= kMaxName, "setLight.group",
                  "must be at most 64 characters");
    if (!light.photometry().empty()) {
        const std::string problem = photometry_name_problem(light.photometry());
        check.require(problem.empty(), "setLight.photometry", problem);
    }
    check_place(light, check);
    check_fade(light, check);
}

void check_body(const v1::AddObject& object, MessageChecker& check) {
    check_addition(object, check);
}

void check_body(const v1::RemoveObject& object, MessageChecker& check) {
    check.require(object.object() >= 1, "removeObject.object", "is missing");
}

void check_body(const v1::AddLuminaire& luminaire, MessageChecker& check) {
    check_addition(luminaire, check);
}

void check_body(const v1::RemoveLight& light, MessageChecker& check) {
    check.require(light.light() >= 1, "removeLight.light", "is missing");
}

void check_body(const v1::SetGroup& group, MessageChecker& check) {
    const std::size_t length = characters(group.group());
    check.require(length >= 1 && length <= kMaxName, "setGroup.group", "must be 1..64 characters");
    check.require(group.has_dim() || group.has_on() || group.lights_size() > 0, "setGroup",
                  "changes nothing: needs dim, on or lights");
    check.require(group.lights_size() <= kMaxGroupLights, "setGroup.lights",
                  "must be at most 4096 numbers");
    check.share(group.dim(), "setGroup.dim");
    check_fade(group.fade_seconds(), "setGroup.fadeSeconds", check);
}

void check_body(const v1::SetDaylight& daylight, MessageChecker& check) {
    check.require(daylight.ByteSizeLong() > 0, "setDaylight",
                  "changes nothing: needs sky, time or sunElevation");
    check.require(daylight.lights_size() == 0, "setDaylight.lights", "is said by the server");
    check.require(std::abs(daylight.place().latitude()) <= 90.0F, "setDaylight.place.latitude",
                  "must be -90..90 degrees");
    check.require(std::abs(daylight.place().longitude()) <= 180.0F, "setDaylight.place.longitude",
                  "must be -180..180 degrees");
    check.require(std::abs(daylight.north()) <= kMaxTurn, "setDaylight.north",
                  "must be -360..360 degrees");
    check.require(std::abs(daylight.sun_elevation()) <= 90.0F, "setDaylight.sunElevation",
                  "must be -90..90 degrees");
    check.require(std::abs(daylight.sun_azimuth()) <= kMaxTurn, "setDaylight.sunAzimuth",
                  "must be -360..360 degrees");
    const bool angles = daylight.has_sun_elevation() || daylight.has_sun_azimuth();
    check.require(!angles || (daylight.time().empty() && !daylight.has_place()),
                  "setDaylight.sunElevation", "stands beside place or time: needs one of them");
    check.require(daylight.zenith_luminance() >= 0.0F, "setDaylight.zenithLuminance",
                  "must not be negative");
    check.require(daylight.sun_illuminance() >= 0.0F, "setDaylight.sunIlluminance",
                  "must not be negative");
    if (daylight.has_turbidity()) {
        const float turbidity = daylight.turbidity();
        check.require(turbidity >= 1.0F && turbidity <= 20.0F, "setDaylight.turbidity",
                      "must be 1..20");
    }
}

void check_body(const v1::SaveLightingScene& scene, MessageChecker& check) {
    check_scene_name(scene.name(), "saveLightingScene.name", check);
}

void check_body(const v1::ApplyLightingScene& scene, MessageChecker& check) {
    check_scene_name(scene.name(), "applyLightingScene.name", check);
    check_fade(scene.fade_seconds(), "applyLightingScene.fadeSeconds", check);
}

void check_body(const v1::RemoveLightingScene& scene, MessageChecker& check) {
    check_scene_name(scene.name(), "removeLightingScene.name", check);
}

void check_body(const v1::PlayAnimation& play, MessageChecker& check) {
    constexpr float max_speed = 100.0F;
    check.require(!play.animation().empty(), "playAnimation.animation", "is missing");
    check.require(play.has_playing() || play.has_seconds() || play.has_speed() || play.has_loop(),
                  "playAnimation", "changes nothing: needs playing, seconds, speed or loop");
    check.require(play.seconds() >= 0.0F, "playAnimation.seconds", "must not be negative");
    check.require(std::abs(play.speed()) <= max_speed, "playAnimation.speed", "must be -100..100");
}

void check_body(const v1::SetMaterial& material, MessageChecker& check) {
    check.require(material.material() >= 1, "setMaterial.material", "is missing");
    check.require(material.has_base_colour() || material.has_roughness() || material.has_metallic(),
                  "setMaterial", "changes nothing: needs baseColour, roughness or metallic");
    check.colour(material.base_colour(), 1.0F, "setMaterial.baseColour", "must be 0..1");
    check.share(material.roughness(), "setMaterial.roughness");
    check.share(material.metallic(), "setMaterial.metallic");
}

void check_body(const v1::OpenScene& open, MessageChecker& check) {
    const std::string problem = scene_name_problem(open.name());
    check.require(problem.empty(), "openScene.name", problem);
}

}  // namespace raybundle
