// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace raybundle {

struct TriangleCorners {
    glm::vec3 a, b, c;
};

/// Unit normal of the front; 0 of a triangle without area.
glm::vec3 front_normal(const TriangleCorners& t);

/// Point of a triangle that is nearest to another point: above the triangle its foot, elsewhere the
/// nearest point of an edge.
glm::vec3 nearest_point(const TriangleCorners& t, const glm::vec3& point);

}  // namespace raybundle
