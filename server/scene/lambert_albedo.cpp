// SPDX-License-Identifier: Apache-2.0
#include "scene/lambert_albedo.h"

namespace raybundle {
namespace {

glm::vec3 unclamped(const Material& material, const glm::vec3& colour) {
    const glm::vec3 dielectric = colour * (1.0F - material.metallic);
    const glm::vec3 metal = colour * material.metallic;
    return dielectric + metal;
}

}  // namespace

glm::vec3 lambert_albedo(const Material& material, const glm::vec3& colour) {
    return glm::clamp(unclamped(material, colour), 0.0F, max_albedo);
}

bool exceeds_max_albedo(const Material& material, const glm::vec3& colour) {
    return glm::any(glm::greaterThan(unclamped(material, colour), glm::vec3(max_albedo)));
}

}  // namespace raybundle
