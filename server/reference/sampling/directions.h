// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

namespace raybundle {

/// Orthonormal frame about a unit vector z (Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited").
struct Frame {
    glm::dvec3 x, y, z;

    explicit Frame(const glm::dvec3& normal) : z(normal) {
        const double sign = std::copysign(1.0, z.z);
        const double a = -1.0 / (sign + z.z);
        const double b = z.x * z.y * a;
        x = {1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x};
        y = {b, sign + z.y * z.y * a, -z.y};
    }

    [[nodiscard]] glm::dvec3 to_world(const glm::dvec3& local) const {
        return local.x * x + local.y * y + local.z * z;
    }
    [[nodiscard]] glm::dvec3 to_local(const glm::dvec3& world) const {
        return {glm::dot(world, x), glm::dot(world, y), glm::dot(world, z)};
    }
};

/// Direction with density cos/pi over the hemisphere of +z, from two uniform numbers.
inline glm::dvec3 cosine_hemisphere(const glm::dvec2& u) {
    const double angle = glm::two_pi<double>() * u.x;
    const double radius = std::sqrt(u.y);
    return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - u.y)};
}

/// Barycentric coordinates of a uniformly distributed point of a triangle (weights of vertices 1
/// and 2), from two uniform numbers.
inline glm::dvec2 uniform_triangle(const glm::dvec2& u) {
    const double root = std::sqrt(u.x);
    return {root * (1.0 - u.y), root * u.y};
}

}  // namespace raybundle
