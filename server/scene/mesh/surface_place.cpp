// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/surface_place.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raybundle {
namespace {

/// Derived: two single roundings of a coordinate, when the point was projected and when it is
/// measured from; twice that for the sums between.
constexpr float place_rounding = 4.0F * std::numeric_limits<float>::epsilon();

struct TriangleCorners {
    glm::vec3 a, b, c;
};

TriangleCorners triangle_corners(const PatchMesh& mesh, std::uint32_t triangle) {
    const glm::uvec3& vertex = mesh.triangles[triangle];
    return {mesh.positions[vertex.x], mesh.positions[vertex.y], mesh.positions[vertex.z]};
}

/// Unit normal of the front; 0 of a triangle without area.
glm::vec3 front_normal(const TriangleCorners& t) {
    const glm::vec3 across = glm::cross(t.b - t.a, t.c - t.a);
    const float length = glm::length(across);
    return length > 0.0F ? across / length : glm::vec3(0.0F);
}

glm::vec3 nearest_on_edge(const glm::vec3& from, const glm::vec3& to, const glm::vec3& point) {
    const glm::vec3 edge = to - from;
    const float length2 = glm::dot(edge, edge);
    const float share = length2 > 0.0F ? glm::dot(point - from, edge) / length2 : 0.0F;
    return from + std::clamp(share, 0.0F, 1.0F) * edge;
}

/// Above the triangle its foot, elsewhere the nearest point of an edge.
glm::vec3 nearest_in(const TriangleCorners& t, const glm::vec3& point) {
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

}  // namespace

SurfacePlace surface_place(const PatchMesh& mesh, std::uint32_t side, const glm::vec3& near) {
    const std::uint32_t triangle = mesh.side_triangle[side];
    const TriangleCorners corners = triangle_corners(mesh, triangle);
    const glm::vec3 normal = front_normal(corners);
    return {mesh.vertex_object[mesh.triangles[triangle].x], nearest_in(corners, near),
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
        const float distance = glm::distance(nearest_in(corners, point.position), point.position);
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
