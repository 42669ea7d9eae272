// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "net/ws/rules/message_checker.h"

namespace raybundle {

constexpr float kMinFov = 0.001F;  ///< radians
constexpr float kMaxFov = 3.14F;   ///< radians

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

inline void check_fov(float fov, const std::string& field, MessageChecker& check) {
    check.require(fov >= kMinFov && fov <= kMaxFov, field, "must be 0.001..3.14 radians");
}

}  // namespace raybundle
