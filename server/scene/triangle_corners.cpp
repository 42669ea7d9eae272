// SPDX-License-Identifier: Apache-2.0
#include "scene/triangle_corners.h"

#include <algorithm>

namespace raybundle {
namespace {

glm::vec3 nearest_on_edge(const glm::vec3& from, const glm::vec3& to, const glm::vec3& point) {
    const glm::vec3 edge = to - from;
    const float length2 = glm::dot(edge, edge);
    const float share = length2 > 0.0F ? glm::dot(point - from, edge) / length2 : 0.0F;
    return from + std::clamp(share, 0.0F, 1.0F) * edge;
}

}  // namespace

glm::vec3 front_normal(const TriangleCorners& t) {
    const glm::vec3 across = glm::cross(t.b - t.a, t.c - t.a);
    const float length = glm::length(across);
    return length > 0.0F ? across / length : glm::vec3(0.0F);
}

glm::vec3 nearest_point(const TriangleCorners& t, const glm::vec3& point) {
    const glm::vec3 normal = front_normal(t);
    const auto inside = [&](const glm::vec3& from, const glm::vec3& to) {
        return glm::dot(glm::cross(to - from, point - from), normal) >= 0.0F;
    };
    if (normal != glm::vec3(0.0F) && inside(t.a, t.b) && inside(t.b, t.c) && inside(t.c, t.a)) {
        return point - glm::dot(point - t.a, normal) * normal;
    }
    glm::vec3 nearest = nearest_on_edge(t.a, t.b, point);
    for (const glm::vec3& other :
         {nearest_on_edge(t.b, t.c, point), nearest_on_edge(t.c, t.a, point)}) {
        nearest = glm::distance(other, point) < glm::distance(nearest, point) ? other : nearest;
    }
    return nearest;
}

}  // namespace raybundle
