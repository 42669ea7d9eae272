// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace raybundle {

/// Transforms normals like an inverse transpose (up to a positive factor), singular matrices too.
inline glm::dmat3 normal_matrix(const glm::dmat4& matrix) {
    const glm::dmat3 m(matrix);
    const double sign = glm::determinant(m) < 0.0 ? -1.0 : 1.0;
    return sign *
           glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
}

inline glm::vec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 1e-30 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0F);
}

}  // namespace raybundle
