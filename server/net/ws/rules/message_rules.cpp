// SPDX-License-Identifier: Apache-2.0
#include "net/ws/rules/message_rules.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <iterator>
#include <string>
#include <vector>

#include "net/http/scene_name.h"
#include "net/ws/rules/addition_rules.h"
#include "net/ws/rules/measure_rules.h"
#include "net/ws/rules/message_checker.h"

namespace raybundle {
namespace {

using Client = v1::ClientMessage;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr double kMaxNumber = 1e9;  ///< metres, seconds, photometric units: keeps squares finite
constexpr float kMaxNear = 1e9F;    // m, as the coordinates of a Vec3
constexpr float kMinFov = 0.001F;   ///< radians
constexpr float kMaxFov = 3.14F;    ///< radians
constexpr int kMaxGroupLights = 4096;
constexpr float kMaxCone = 90.0F;  ///< degrees
constexpr float kMinKelvin = 1000.0F;
constexpr float kMaxKelvin = 25000.0F;
constexpr std::size_t kMaxText = 500;    ///< characters of a pin
constexpr std::size_t kMaxToken = 8192;  ///< bytes; of a JWT
constexpr float kMaxExposure = 30.0F;    ///< EV
constexpr float kMaxSeconds = 86400.0F;
constexpr std::uint64_t kMaxGridPoints = 1024;
constexpr std::uint32_t kMaxDepthColumns = 512;

/// Of a request that may be asked for again.
bool is_request_key(const std::string& text) {
    return !text.empty() && text.size() <= kMaxName &&
           std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~'; });
}

double number(const Message& message, const FieldDescriptor& field) {
    const auto* const reflection = message.GetReflection();
    switch (field.cpp_type()) {
        case FieldDescriptor::CPPTYPE_FLOAT:
            return reflection->GetFloat(message, &field);
        case FieldDescriptor::CPPTYPE_DOUBLE:
            return reflection->GetDouble(message, &field);
        default:
            return 0.0;
    }
}

/// Every float and double of the message and its parts is finite and of a size one can square.
/// The depth is that of the schema, which is not recursive.
void check_numbers(const Message& message, const std::string& path, MessageChecker& check) {
    const auto* const reflection = message.GetReflection();
    std::vector<const FieldDescriptor*> fields;
    reflection->ListFields(message, &fields);
    for (const auto* field : fields) {
        const std::string name = path + (path.empty() ? "" : ".") + field->json_name();
        if (field->is_repeated()) {  // codecs, or messages
            const bool messages = field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
            for (int i = 0; messages && i < reflection->FieldSize(message, field); ++i) {
                check_numbers(reflection->GetRepeatedMessage(message, field, i), name, check);
            }
            continue;
        }
        if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
            check_numbers(reflection->GetMessage(message, field), name, check);
        } else {
            const double value = number(message, *field);
            check.require(std::isfinite(value), name, "must be a finite number");
            check.require(std::abs(value) <= kMaxNumber, name, "must be at most 1e9");
        }
    }
}

void check_body(const v1::Hello& hello, MessageChecker& check) {
    check.require(!hello.protocol().empty(), "hello.protocol", "is missing");
    check.require(characters(hello.name()) <= kMaxName, "hello.name",
                  "must be at most 64 characters");
    check.require(hello.token().size() <= kMaxToken, "hello.token", "must be at most 8192 bytes");
    if (hello.has_viewport()) {
        check.size(hello.viewport(), true, "hello.viewport");
    }
}

/// Where a camera stands: SetCamera or SaveViewpoint, called `name` in complaints.
template <typename View>
void check_view(const View& view, const std::string& name, MessageChecker& check) {
    check.require(view.has_eye(), name + ".eye", "is missing");
    check.require(view.has_target(), name + ".target", "is missing");
    const glm::dvec3 sight = to_vector(view.target()) - to_vector(view.eye());
    check.require(glm::length(sight) >= kMinLength, name + ".target", "must differ from eye");
    const glm::dvec3 up = view.has_up() ? to_vector(view.up()) : glm::dvec3(0, 1, 0);
    check.require(glm::length(up) >= kMinLength, name + ".up", "must not be zero");
    const double sine = glm::length(glm::cross(glm::normalize(sight), glm::normalize(up)));
    check.require(sine >= kMinLength, name + ".up", "must not lie along the line of sight");
}

void check_fov(float fov, const std::string& field, MessageChecker& check) {
    check.require(fov >= kMinFov && fov <= kMaxFov, field, "must be 0.001..3.14 radians");
}

void check_body(const v1::SetCamera& camera, MessageChecker& check) {
    check_view(camera, "setCamera", check);
    if (camera.has_vertical_fov()) {
        check_fov(camera.vertical_fov(), "setCamera.verticalFov", check);
    }
    if (camera.has_near()) {
        check.require(camera.near() >= 0.0F && camera.near() <= kMaxNear, "setCamera.near",
                      "must be 0..1e9 m");
    }
}

void check_body(const v1::GetWalkMap& map, MessageChecker& check) {
    check.require(map.has_eye(), "getWalkMap.eye", "is missing");
}

void check_body(const v1::SetViewport& viewport, MessageChecker& check) {
    check.size(viewport, true, "setViewport");
}

void check_body(const v1::SetTarget& target, MessageChecker& check) {
    if (target.has_relative_error()) {
        const float error = target.relative_error();
        check.require(error > 0.0F && error <= 1.0F, "setTarget.relativeError",
                      "must be above 0 and at most 1");
    }
    if (target.has_seconds()) {
        const float seconds = target.seconds();
        check.require(seconds > 0.0F && seconds <= kMaxSeconds, "setTarget.seconds",
                      "must be above 0 and at most 86400");
    }
}

void check_body(const v1::SetDisplay& display, MessageChecker& check) {
    check.require(display.ByteSizeLong() > 0, "setDisplay",
                  "changes nothing: needs mode, exposure, autoExposure, scaleMaximum, isolines, "
                  "scaleUnit or linearScale");
    if (display.has_mode()) {
        check.require(v1::SetDisplay::Mode_IsValid(display.mode()) &&
                          display.mode() != v1::SetDisplay::MODE_UNSPECIFIED,
                      "setDisplay.mode", "must be PHOTO, FALSE_LUMINANCE or FALSE_ILLUMINANCE");
    }
    check.require(std::abs(display.exposure()) <= kMaxExposure, "setDisplay.exposure",
                  "must be -30..30");
    check.require(display.scale_maximum() >= 0.0F, "setDisplay.scaleMaximum",
                  "must not be negative");
    check.require(!display.has_scale_unit() || display.scale_unit() > 0.0F, "setDisplay.scaleUnit",
                  "must be above 0");
}

void check_body(const v1::SetDepths& depths, MessageChecker& check) {
    const std::uint32_t columns = depths.columns();
    check.require(columns == 0 || (columns >= 2 && columns <= kMaxDepthColumns),
                  "setDepths.columns", "must be 0 or 2..512");
}

void check_body(const v1::MoveObject& move, MessageChecker& check) {
    check.require(move.object() >= 1, "moveObject.object", "is missing");
    check.require(move.has_transform(), "moveObject.transform", "is missing");
    check_transform(move.transform(), "moveObject.transform", check);
}

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

void check_body(const v1::SetLight& light, MessageChecker& check) {
    check.require(light.light() >= 1, "setLight.light", "is missing");
    v1::SetLight number;
    number.set_light(light.light());
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
    check.require(characters(light.group()) <= kMaxName, "setLight.group",
                  "must be at most 64 characters");
    if (!light.photometry().empty()) {
        const std::string problem = photometry_name_problem(light.photometry());
        check.require(problem.empty(), "setLight.photometry", problem);
    }
    check_place(light, check);
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

void check_scene_name(const std::string& name, std::string_view field, MessageChecker& check) {
    const std::size_t length = characters(name);
    check.require(length >= 1 && length <= kMaxName, field, "must be 1..64 characters");
}

void check_body(const v1::SaveLightingScene& scene, MessageChecker& check) {
    check_scene_name(scene.name(), "saveLightingScene.name", check);
}

void check_body(const v1::ApplyLightingScene& scene, MessageChecker& check) {
    check_scene_name(scene.name(), "applyLightingScene.name", check);
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

void check_body(const v1::Probe& probe, MessageChecker& check) {
    check.require(probe.where_case() != v1::Probe::WHERE_NOT_SET, "probe",
                  "needs a pixel or a ray");
    if (probe.has_pixel()) {
        check.require(probe.pixel().x() >= 0.0F && probe.pixel().y() >= 0.0F, "probe.pixel",
                      "must not be negative");
    }
    if (probe.has_ray()) {
        check.require(probe.ray().has_origin(), "probe.ray.origin", "is missing");
        check.require(glm::length(to_vector(probe.ray().direction())) >= kMinLength,
                      "probe.ray.direction", "must not be zero");
    }
}

void check_body(const v1::AddPin& pin, MessageChecker& check) {
    const std::size_t length = characters(pin.text());
    check.require(length >= 1 && length <= kMaxText, "addPin.text", "must be 1..500 characters");
    check.require(pin.has_position(), "addPin.position", "is missing");
}

void check_body(const v1::RemovePin& pin, MessageChecker& check) {
    check.require(pin.pin() >= 1, "removePin.pin", "is missing");
}

void check_body(const v1::SaveViewpoint& viewpoint, MessageChecker& check) {
    const std::size_t length = characters(viewpoint.name());
    check.require(length >= 1 && length <= kMaxName, "saveViewpoint.name",
                  "must be 1..64 characters");
    check_view(viewpoint, "saveViewpoint", check);
    check_fov(viewpoint.vertical_fov(), "saveViewpoint.verticalFov", check);
}

void check_body(const v1::RemoveViewpoint& viewpoint, MessageChecker& check) {
    check.require(viewpoint.viewpoint() >= 1, "removeViewpoint.viewpoint", "is missing");
}

void check_body(const v1::PointAt& point, MessageChecker& check) {
    check.require(point.has_position(), "pointAt.position", "is missing");
}

void check_body(const v1::ProbeGrid& grid, MessageChecker& check) {
    check.require(grid.has_origin(), "probeGrid.origin", "is missing");
    const glm::dvec3 x = to_vector(grid.step_x());
    const glm::dvec3 y = to_vector(grid.step_y());
    check.require(glm::length(x) >= kMinLength, "probeGrid.stepX", "must not be zero");
    check.require(glm::length(y) >= kMinLength, "probeGrid.stepY", "must not be zero");
    const double sine = glm::length(glm::cross(glm::normalize(x), glm::normalize(y)));
    check.require(sine >= kMinLength, "probeGrid.stepY", "must not lie along stepX");
    const std::uint64_t points = std::uint64_t{grid.columns()} * grid.rows();
    check.require(points >= 1 && points <= kMaxGridPoints, "probeGrid.columns",
                  "columns times rows must be 1..1024");
}

void check_body(const v1::Measure& measure, MessageChecker& check) {
    check_measure(measure, check);
}

void check_body(const v1::RemoveMeasurement& measurement, MessageChecker& check) {
    check.require(measurement.measurement() >= 1, "removeMeasurement.measurement", "is missing");
}

void check_body(const v1::SetZone& zone, MessageChecker& check) {
    check_zone(zone, check);
}

void check_body(const v1::SetRequirement& set, MessageChecker& check) {
    check_requirement(set, check);
}

void check_body(const v1::ReplyToPin& reply, MessageChecker& check) {
    const std::size_t length = characters(reply.text());
    check.require(length >= 1 && length <= kMaxText, "replyToPin.text",
                  "must be 1..500 characters");
}

void check_body(const v1::SetPin& pin, MessageChecker& check) {
    check.require(characters(pin.assigned_to()) <= kMaxName, "setPin.assignedTo",
                  "must be at most 64 characters");
}

void check_body(const v1::Ack& ack, MessageChecker& check) {
    check.require(ack.decode_ms() >= 0.0, "ack.decodeMs", "must not be negative");
}

void check_body(const v1::AckLight& ack, MessageChecker& check) {
    check.require(ack.light() >= 1, "ackLight.light", "is missing");
}

void check_body(const v1::Snapshot& snapshot, MessageChecker& check) {
    check.size(snapshot, false, "snapshot");
    check.require(snapshot.relative_error() > 0.0F && snapshot.relative_error() <= 1.0F,
                  "snapshot.relativeError", "must be above 0 and at most 1");
    check.require(snapshot.format() == v1::Snapshot::EXR || snapshot.format() == v1::Snapshot::PNG,
                  "snapshot.format", "must be EXR or PNG");
}

void check_body(const v1::OpenScene& open, MessageChecker& check) {
    const std::string problem = scene_name_problem(open.name());
    check.require(problem.empty(), "openScene.name", problem);
}

/// Checks the body that a message has, e.g. ClientMessage::set_camera.
template <auto body>
void check(const Client& message, MessageChecker& checker) {
    check_body((message.*body)(), checker);
}

constexpr MessageRule rules[] = {
    {Client::kHello, v1::VIEWER, Waiting::queued, check<&Client::hello>},
    {Client::kSetCamera, v1::VIEWER, Waiting::newest_only, check<&Client::set_camera>},
    {Client::kSetViewport, v1::VIEWER, Waiting::newest_only, check<&Client::set_viewport>},
    {Client::kSetTarget, v1::VIEWER, Waiting::queued, check<&Client::set_target>},
    {Client::kSetDisplay, v1::VIEWER, Waiting::queued, check<&Client::set_display>},
    {Client::kSetDepths, v1::VIEWER, Waiting::queued, check<&Client::set_depths>},
    {Client::kSetHidden, v1::VIEWER, Waiting::queued, nullptr},
    {Client::kGetWalkMap, v1::VIEWER, Waiting::queued, check<&Client::get_walk_map>},
    {Client::kFollow, v1::VIEWER, Waiting::queued, nullptr},
    {Client::kProbe, v1::VIEWER, Waiting::queued, check<&Client::probe>},
    {Client::kProbeGrid, v1::VIEWER, Waiting::queued, check<&Client::probe_grid>},
    {Client::kMeasure, v1::VIEWER, Waiting::queued, check<&Client::measure>},
    {Client::kRemoveMeasurement, v1::VIEWER, Waiting::queued, check<&Client::remove_measurement>},
    {Client::kSnapshot, v1::VIEWER, Waiting::queued, check<&Client::snapshot>},
    {Client::kCancelSnapshot, v1::VIEWER, Waiting::queued, nullptr},
    {Client::kListChanges, v1::VIEWER, Waiting::queued, nullptr},
    {Client::kAck, v1::VIEWER, Waiting::queued, check<&Client::ack>},
    {Client::kPing, v1::VIEWER, Waiting::queued, nullptr},
    {Client::kAckLight, v1::VIEWER, Waiting::queued, check<&Client::ack_light>},
    {Client::kSetDrawing, v1::VIEWER, Waiting::queued, nullptr},
    {Client::kAddPin, v1::REVIEWER, Waiting::queued, check<&Client::add_pin>},
    {Client::kRemovePin, v1::REVIEWER, Waiting::queued, check<&Client::remove_pin>},
    {Client::kSaveViewpoint, v1::REVIEWER, Waiting::queued, check<&Client::save_viewpoint>},
    {Client::kRemoveViewpoint, v1::REVIEWER, Waiting::queued, check<&Client::remove_viewpoint>},
    {Client::kPointAt, v1::REVIEWER, Waiting::queued, check<&Client::point_at>},
    {Client::kReplyToPin, v1::REVIEWER, Waiting::queued, check<&Client::reply_to_pin>},
    {Client::kSetPin, v1::REVIEWER, Waiting::queued, check<&Client::set_pin>},
    {Client::kSetZone, v1::REVIEWER, Waiting::queued, check<&Client::set_zone>},
    {Client::kSetRequirement, v1::EDITOR, Waiting::queued, check<&Client::set_requirement>},
    {Client::kRemoveRequirement, v1::EDITOR, Waiting::queued, nullptr},
    {Client::kMoveObject, v1::EDITOR, Waiting::newest_only, check<&Client::move_object>},
    {Client::kSetLight, v1::EDITOR, Waiting::queued, check<&Client::set_light>},
    {Client::kSetMaterial, v1::EDITOR, Waiting::queued, check<&Client::set_material>},
    {Client::kSetDaylight, v1::EDITOR, Waiting::queued, check<&Client::set_daylight>},
    {Client::kSetGroup, v1::EDITOR, Waiting::queued, check<&Client::set_group>},
    {Client::kSaveLightingScene, v1::EDITOR, Waiting::queued, check<&Client::save_lighting_scene>},
    {Client::kApplyLightingScene, v1::EDITOR, Waiting::queued,
     check<&Client::apply_lighting_scene>},
    {Client::kRemoveLightingScene, v1::EDITOR, Waiting::queued,
     check<&Client::remove_lighting_scene>},
    {Client::kPlayAnimation, v1::EDITOR, Waiting::queued, check<&Client::play_animation>},
    {Client::kAddObject, v1::EDITOR, Waiting::queued, check<&Client::add_object>},
    {Client::kRemoveObject, v1::EDITOR, Waiting::queued, check<&Client::remove_object>},
    {Client::kAddLuminaire, v1::EDITOR, Waiting::queued, check<&Client::add_luminaire>},
    {Client::kRemoveLight, v1::EDITOR, Waiting::queued, check<&Client::remove_light>},
    {Client::kUndo, v1::EDITOR, Waiting::queued, nullptr},
    {Client::kListScenes, v1::EDITOR, Waiting::queued, nullptr},
    {Client::kOpenScene, v1::EDITOR, Waiting::queued, check<&Client::open_scene>},
    {Client::kMeasureEffects, v1::EDITOR, Waiting::queued, nullptr},
};

}  // namespace

std::span<const MessageRule> message_rules() {
    return rules;
}

const MessageRule* rule_of(Client::BodyCase body) {
    const auto* const found =
        std::find_if(std::begin(rules), std::end(rules),
                     [body](const MessageRule& rule) { return rule.body == body; });
    return found == std::end(rules) ? nullptr : found;
}

v1::Role required_role(Client::BodyCase body) {
    const MessageRule* const rule = rule_of(body);
    return rule == nullptr ? v1::VIEWER : rule->role;
}

std::optional<Refusal> validate(const Client& message, const WireLimits& limits) {
    MessageChecker checker(limits);
    check_numbers(message, "", checker);
    checker.require(!message.has_request_key() || is_request_key(message.request_key()),
                    "requestKey", "must be 1..64 visible ASCII characters");
    if (const MessageRule* const rule = rule_of(message.body_case());
        rule != nullptr && rule->check != nullptr) {
        rule->check(message, checker);
    }
    return checker.result();
}

}  // namespace raybundle
