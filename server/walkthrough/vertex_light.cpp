// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/vertex_light.h"

#include <cstddef>

namespace raybundle {

namespace {

void divide(std::vector<glm::vec3>& sums, const std::vector<float>& areas) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] = areas[i] > 0.0F ? sums[i] / areas[i] : glm::vec3(0.0F);
    }
}

}  // namespace

VertexLight light_at_vertices(const PatchMesh& mesh, std::span<const glm::vec3> world,
                              std::span<const glm::vec4> irradiance) {
    VertexLight light{std::vector<glm::vec3>(world.size()), std::vector<glm::vec3>(world.size())};
    std::vector<float> front_areas(world.size());
    std::vector<float> back_areas(world.size());
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const glm::uvec3& v = mesh.triangles[t];
        const float area =
            0.5F * glm::length(glm::cross(world[v.y] - world[v.x], world[v.z] - world[v.x]));
        const glm::vec3 front = area * glm::vec3(irradiance[mesh.patch_of(t)]);
        const std::uint32_t twin = mesh.back_side[t];
        for (const std::uint32_t vertex : {v.x, v.y, v.z}) {
            light.front[vertex] += front;
            front_areas[vertex] += area;
            if (twin != PatchMesh::no_patch) {
                light.back[vertex] += area * glm::vec3(irradiance[mesh.patch_of(twin)]);
                back_areas[vertex] += area;
            }
        }
    }
    divide(light.front, front_areas);
    divide(light.back, back_areas);
    return light;
}

std::vector<glm::vec3> world_positions(const Scene& scene, const PatchMesh& mesh) {
    std::vector<glm::vec3> result(mesh.positions.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const glm::mat4 world = scene.objects[mesh.vertex_object[i]].world_from_object();
        result[i] = glm::vec3(world * glm::vec4(mesh.positions[i], 1.0F));
    }
    return result;
}

std::vector<glm::vec3> world_normals(const Scene& scene, const PatchMesh& mesh) {
    std::vector<glm::vec3> result(mesh.normals.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const glm::mat3 m(scene.objects[mesh.vertex_object[i]].world_from_object());
        // Normals transform by the cofactor matrix (the inverse transpose times the determinant).
        const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                                  glm::cross(m[0], m[1]));
        const glm::vec3 normal = cofactors * mesh.normals[i];
        const float size = glm::length(normal);
        const float mirrored = glm::determinant(m) < 0.0F ? -1.0F : 1.0F;
        result[i] = size > 0.0F ? mirrored * normal / size : glm::vec3(0.0F);
    }
    return result;
}

}  // namespace raybundle
