// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <glm/gtc/constants.hpp>
#include <iterator>
#include <string>

#include "scene/gltf/gltf_loader.h"

namespace raybundle::test {

/// A file of tests/cases.
inline std::string case_path(const std::string& name) {
    return std::string(RAYBUNDLE_CASES) + "/" + name;
}

inline std::string case_bytes(const std::string& name) {
    std::ifstream in(case_path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Illuminance of a level floor at a point by a scene's punctual lights, none of them hidden, lx.
inline double direct_illuminance(const Scene& scene, const glm::dvec3& point) {
    double sum = 0.0;
    for (const PunctualLight& light : scene.punctual_lights) {
        const PlacedLight placed = place_light(scene, light);
        const glm::dvec3 to_point = point - placed.position;
        const double distance = glm::length(to_point);
        const glm::dvec3 direction = to_point / distance;
        sum += placed.towards(direction).g * -direction.y / (distance * distance);
    }
    return sum;
}

}  // namespace raybundle::test
