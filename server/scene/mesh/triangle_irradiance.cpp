// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/triangle_irradiance.h"

#include <cmath>
#include <cstddef>

namespace raybundle {

double triangle_irradiance(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& point,
                           const glm::dvec3& normal) {
    std::array<glm::dvec3, 4> above{};  // the part above the horizon, seen from the point
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 a = corners[k] - point;
        const glm::dvec3 b = corners[(k + 1) % 3] - point;
        const double height_a = glm::dot(a, normal);
        const double height_b = glm::dot(b, normal);
        if (height_a >= 0.0) {
            above[count++] = a;
        }
        if ((height_a < 0.0 && height_b > 0.0) || (height_a > 0.0 && height_b < 0.0)) {
            above[count++] = glm::mix(a, b, height_a / (height_a - height_b));
        }
    }
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        const glm::dvec3& a = above[k];
        const glm::dvec3& b = above[(k + 1) % count];
        const glm::dvec3 across = glm::cross(a, b);
        const double length = glm::length(across);
        if (length > 0.0) {
            sum += std::atan2(length, glm::dot(a, b)) * glm::dot(across, normal) / length;
        }
    }
    return 0.5 * std::abs(sum);
}

}  // namespace raybundle
