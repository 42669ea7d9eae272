// SPDX-License-Identifier: Apache-2.0
#include "scene/material/normal_map.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

glm::dvec3 mapped_normal(const TangentEdges& triangle, const glm::dvec3& normal,
                         const glm::dvec3& texel, double scale) {
    const double mirrored = triangle.uv1.x * triangle.uv2.y - triangle.uv1.y * triangle.uv2.x;
    const double sign = mirrored < 0.0 ? -1.0 : 1.0;
    // Directions in which u and v grow, by Cramer's rule without its determinant.
    const glm::dvec3 along_u =
        sign * (triangle.edge1 * triangle.uv2.y - triangle.edge2 * triangle.uv1.y);
    const glm::dvec3 along_v =
        sign * (triangle.edge2 * triangle.uv1.x - triangle.edge1 * triangle.uv2.x);
    const glm::dvec3 x = along_u - glm::dot(along_u, normal) * normal;
    const double length = glm::length(x);
    if (mirrored == 0.0 || !(length > 0.0)) {
        return normal;
    }
    const glm::dvec3 tangent = x / length;
    glm::dvec3 bitangent = glm::cross(normal, tangent);
    if (glm::dot(bitangent, along_v) > 0.0) {
        bitangent = -bitangent;
    }
    const glm::dvec3 local = texel * 2.0 - 1.0;
    return glm::normalize(scale * (local.x * tangent + local.y * bitangent) +
                          std::max(local.z, least_map_height) * normal);
}

glm::dvec3 facing_normal(const glm::dvec3& normal, const glm::dvec3& to_eye) {
    const double cosine = glm::dot(normal, to_eye);
    if (cosine >= least_view_cosine) {
        return normal;
    }
    const glm::dvec3 across = normal - cosine * to_eye;
    const double length = glm::length(across);
    if (!(length > 1e-9)) {
        return to_eye;
    }
    return least_view_cosine * to_eye +
           std::sqrt(1.0 - least_view_cosine * least_view_cosine) / length * across;
}

}  // namespace raybundle
