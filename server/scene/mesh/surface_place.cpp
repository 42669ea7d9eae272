// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/surface_place.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/triangle_corners.h"

namespace raybundle {
namespace {

/// Derived: two single roundings of a coordinate, when the point was projected and when it is
/// measured from; twice that for the sums between.
constexpr float place_rounding = 4.0F * std::numeric_limits<float>::epsilon();

TriangleCorners triangle_corners(const PatchMesh& mesh, std::uint32_t triangle) {
    const glm::uvec3& vertex = mesh.triangles[triangle];
    return {mesh.positions[vertex.x], mesh.positions[vertex.y], mesh.positions[vertex.z]};
}

}  // namespace

SurfacePlace surface_place(const PatchMesh& mesh, std::uint32_t side, const glm::vec3& near) {
    const std::uint32_t triangle = mesh.side_triangle[side];
    const TriangleCorners corners = triangle_corners(mesh, triangle);
    const glm::vec3 normal = front_normal(corners);
    return {mesh.vertex_object[mesh.triangles[triangle].x], nearest_point(corners, near),
            side < mesh.triangle_count() ? normal : -normal};
}

std::optional<std::uint32_t> side_at(const PatchMesh& mesh, const SurfacePlace& point) {
    const glm::vec3 size = glm::abs(point.position);
    const float same = place_rounding * std::max({size.x, size.y, size.z, 1.0F});
    std::optional<std::uint32_t> best;
    float best_distance = std::numeric_limits<float>::max();
    float best_facing = 0.0F;
    for (std::uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
        if (mesh.vertex_object[mesh.triangles[triangle].x] != point.object) {
            continue;
        }
        const TriangleCorners corners = triangle_corners(mesh, triangle);
        const float front = glm::dot(front_normal(corners), point.normal);
        const std::uint32_t side = front >= 0.0F ? triangle : mesh.back_side[triangle];
        const float facing = std::abs(front);
        if (side == PatchMesh::no_patch) {
            continue;
        }
        const float distance =
            glm::distance(nearest_point(corners, point.position), point.position);
        if (distance < best_distance - same ||
            (distance <= best_distance + same && facing > best_facing)) {
            best = side;
            best_distance = distance;
            best_facing = facing;
        }
    }
    return best;
}

}  // namespace raybundle
