// SPDX-License-Identifier: Apache-2.0
#include "net/ws/rules/addition_rules.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "net/http/scene_name.h"

namespace raybundle {
namespace {

constexpr std::uint64_t kMaxField = 1024;  ///< luminaires of one request

}  // namespace

void check_transform(const v1::Transform& transform, const std::string& name,
                     MessageChecker& check) {
    if (transform.has_rotation()) {
        const auto& q = transform.rotation();
        const double length = glm::length(glm::dvec4(q.x(), q.y(), q.z(), q.w()));
        check.require(length >= kMinLength, name + ".rotation", "must not be zero");
    }
    if (transform.has_scale()) {
        const glm::dvec3 scale = glm::abs(to_vector(transform.scale()));
        check.require(std::min({scale.x, scale.y, scale.z}) >= kMinLength, name + ".scale",
                      "must not be zero");
    }
}

void check_addition(const v1::AddObject& object, MessageChecker& check) {
    const int ways = (object.copy_of() > 0 ? 1 : 0) + (object.library().empty() ? 0 : 1) +
                     (object.object() > 0 ? 1 : 0);
    check.require(ways == 1, "addObject", "needs one of copyOf, library and object");
    if (!object.library().empty()) {
        const std::string problem = scene_name_problem(object.library());
        check.require(problem.empty(), "addObject.library", problem);
    }
    check.require(characters(object.name()) <= kMaxName, "addObject.name",
                  "must be at most 64 characters");
    check.require(!object.removed(), "addObject.removed", "is said by removeObject");
    check_transform(object.transform(), "addObject.transform", check);
}

void check_addition(const v1::AddLuminaire& luminaire, MessageChecker& check) {
    check.require(!luminaire.removed(), "addLuminaire.removed", "is said by removeLight");
    if (luminaire.light() > 0) {
        v1::AddLuminaire number;
        number.set_light(luminaire.light());
        check.require(luminaire.ByteSizeLong() == number.ByteSizeLong(), "addLuminaire.light",
                      "brings one back as it was: needs nothing else");
        return;
    }
    const std::string problem = photometry_name_problem(luminaire.photometry());
    check.require(problem.empty(), "addLuminaire.photometry", problem);
    check.require(characters(luminaire.name()) <= kMaxName, "addLuminaire.name",
                  "must be at most 64 characters");
    check.require(characters(luminaire.group()) <= kMaxName, "addLuminaire.group",
                  "must be at most 64 characters");
    check.require(luminaire.has_position(), "addLuminaire.position", "is missing");
    check.require(!luminaire.has_aim() || glm::length(to_vector(luminaire.aim())) >= kMinLength,
                  "addLuminaire.aim", "must not be zero");
    check.require(std::abs(luminaire.rotation()) <= kMaxTurn, "addLuminaire.rotation",
                  "must be -360..360 degrees");
    const std::uint64_t columns = std::max(luminaire.columns(), 1U);
    const std::uint64_t rows = std::max(luminaire.rows(), 1U);
    check.require(columns * rows <= kMaxField, "addLuminaire.columns",
                  "columns times rows must be at most 1024");
    check.require(columns == 1 || glm::length(to_vector(luminaire.column_step())) >= kMinLength,
                  "addLuminaire.columnStep", "must not be zero");
    check.require(rows == 1 || glm::length(to_vector(luminaire.row_step())) >= kMinLength,
                  "addLuminaire.rowStep", "must not be zero");
}

}  // namespace raybundle
