// SPDX-License-Identifier: Apache-2.0
#include "net/ws/rules/message_rules.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "net/ws/rules/change_rules.h"
#include "net/ws/rules/look_rules.h"
#include "net/ws/rules/measure_rules.h"
#include "net/ws/rules/message_checker.h"
#include "net/ws/rules/review_rules.h"

namespace raybundle {
namespace {

using Client = v1::ClientMessage;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

bool is_visible_ascii(const std::string& text, std::size_t most) {
    return !text.empty() && text.size() <= most &&
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

std::string message_name(const Client& message) {
    const auto* const field =
        Client::descriptor()->FindFieldByNumber(static_cast<int>(message.body_case()));
    return field == nullptr ? "message" : field->json_name();
}

v1::Role required_role(Client::BodyCase body) {
    const MessageRule* const rule = rule_of(body);
    return rule == nullptr ? v1::VIEWER : rule->role;
}

std::optional<Refusal> refuse_role(const Client& message, v1::Role role) {
    const v1::Role needed = required_role(message.body_case());
    if (role >= needed) {
        return std::nullopt;
    }
    return Refusal{v1::Error::PERMISSION_DENIED,
                   message_name(message) + ": needs the role " + v1::Role_Name(needed) +
                       ", this viewer has " + v1::Role_Name(role),
                   message.has_id() ? std::optional(message.id()) : std::nullopt};
}

std::optional<Refusal> validate(const Client& message, const WireLimits& limits) {
    MessageChecker checker(limits);
    check_numbers(message, "", checker);
    checker.require(!message.has_request_key() || is_visible_ascii(message.request_key(), kMaxName),
                    "requestKey", "must be 1..64 visible ASCII characters");
    checker.require(
        !message.has_traceparent() || is_visible_ascii(message.traceparent(), kMaxTraceparent),
        "traceparent", "must be 1..128 visible ASCII characters");
    if (const MessageRule* const rule = rule_of(message.body_case());
        rule != nullptr && rule->check != nullptr) {
        rule->check(message, checker);
    }
    return checker.result();
}

}  // namespace raybundle
