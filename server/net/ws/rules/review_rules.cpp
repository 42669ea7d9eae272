// SPDX-License-Identifier: Apache-2.0
#include "net/ws/rules/review_rules.h"

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "net/ws/rules/camera_check.h"

namespace raybundle {
namespace {

constexpr std::size_t kMaxText = 500;  ///< characters of a pin

}  // namespace

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

void check_body(const v1::ReplyToPin& reply, MessageChecker& check) {
    const std::size_t length = characters(reply.text());
    check.require(length >= 1 && length <= kMaxText, "replyToPin.text",
                  "must be 1..500 characters");
}

void check_body(const v1::SetPin& pin, MessageChecker& check) {
    check.require(characters(pin.assigned_to()) <= kMaxName, "setPin.assignedTo",
                  "must be at most 64 characters");
}

}  // namespace raybundle
