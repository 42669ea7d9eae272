// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/joins/join_faces.h"

#include "scene/mesh/patch_mesh.h"

namespace raybundle {

JoinFaces::JoinFaces(const Scene& scene, const PatchMesh& mesh) : mesh_(mesh) {
    for (const Object& object : scene.objects) {
        world_from_object_.emplace_back(object.world_from_object());
    }
}

JoinFace JoinFaces::at(std::uint32_t face) const {
    const std::uint32_t triangle = triangles_[face];
    const glm::uvec3& vertices = mesh_.triangles[triangle];
    const glm::dmat4& world = world_from_object_[mesh_.vertex_object[vertices.x]];
    JoinFace result;
    result.points = points_of(face);
    for (int k = 0; k < 3; ++k) {
        result.corners[static_cast<std::size_t>(k)] =
            glm::dvec3(world * glm::dvec4(glm::dvec3(mesh_.positions[vertices[k]]), 1.0));
    }
    result.colour = mesh_.base_colour[triangle];
    result.two_sided = kinds_[kind_of_[face]].two_sided;
    return result;
}

std::array<std::uint32_t, 3> JoinFaces::points_of(std::uint32_t face) const {
    const glm::uvec3& vertices = mesh_.triangles[triangles_[face]];
    return {vertex_points_[vertices.x], vertex_points_[vertices.y], vertex_points_[vertices.z]};
}

}  // namespace raybundle
