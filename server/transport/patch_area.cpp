// SPDX-License-Identifier: Apache-2.0
#include "transport/patch_area.h"

namespace raybundle {

double world_area(const Scene& scene, const PatchMesh& mesh, std::size_t side) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[side]];
    return area_at(scene.objects[mesh.vertex_object[t.x]].world_from_object(), mesh, side);
}

double area_at(const glm::mat4& world_from_object, const PatchMesh& mesh, std::size_t side) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[side]];
    const glm::mat3 m(world_from_object);
    const glm::vec3 e1 = m * (mesh.positions[t.y] - mesh.positions[t.x]);
    const glm::vec3 e2 = m * (mesh.positions[t.z] - mesh.positions[t.x]);
    return 0.5 * static_cast<double>(glm::length(glm::cross(e1, e2)));
}

double patch_area(const Scene& scene, const PatchMesh& mesh, std::uint32_t patch) {
    double sum = 0.0;
    for (const std::uint32_t side : mesh.sides_of(patch)) {
        sum += world_area(scene, mesh, side);
    }
    return sum;
}

}  // namespace raybundle
