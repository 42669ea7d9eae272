// SPDX-License-Identifier: Apache-2.0
#include "scene/light/light_place.h"

#include <cmath>
#include <glm/gtx/quaternion.hpp>

namespace raybundle {
namespace {

/// The x axis at rotation 0: +x, turned as the shortest way turns straight down to the aim.
glm::dvec3 unrotated_x(const glm::dvec3& aim) {
    return glm::rotation(glm::dvec3(0.0, -1.0, 0.0), aim) * glm::dvec3(1.0, 0.0, 0.0);
}

}  // namespace

LightPlace place_of(const PunctualLight& light) {
    const PlacedLight placed = place_light(light, glm::mat4(1.0F));
    const glm::dvec3 aim = placed.direction();
    const glm::dvec3 x = unrotated_x(aim);
    const double turn =
        std::atan2(glm::dot(placed.axes[0], glm::cross(aim, x)), glm::dot(placed.axes[0], x));
    return {glm::vec3(placed.position), glm::vec3(aim), static_cast<float>(glm::degrees(turn))};
}

void set_place(const LightPlace& place, PunctualLight& light) {
    const bool mirrored = glm::determinant(light.axes) < 0.0F;
    const glm::dvec3 aim = glm::normalize(glm::dvec3(place.aim));
    const glm::dvec3 x0 = unrotated_x(aim);
    const double turn = glm::radians(double{place.rotation});
    const glm::dvec3 x = std::cos(turn) * x0 + std::sin(turn) * glm::cross(aim, x0);
    const glm::dvec3 y = glm::cross(-aim, x);
    light.position = place.position;
    light.axes = glm::mat3(glm::dmat3(x, mirrored ? -y : y, -aim));
}

}  // namespace raybundle
