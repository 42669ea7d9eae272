// SPDX-License-Identifier: Apache-2.0
// What vertices have besides their places.
#include <glm/packing.hpp>
#include <numeric>

#include "gpu/octahedral.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {
namespace {

/// unorm 4x8, square-root encoded.
std::uint32_t packed_colour(const glm::vec3& colour) {
    return glm::packUnorm4x8(glm::vec4(glm::sqrt(glm::clamp(colour, 0.0F, 1.0F)), 1.0F));
}

}  // namespace

void GpuScene::upload_vertex_data(const PatchMesh& mesh) {
    // Compressed rows: for every vertex the triangles that use it.
    std::vector<std::uint32_t> first(mesh.positions.size() + 1, 0);
    for (const glm::uvec3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            ++first[t[k] + 1];
        }
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> vertex_triangles(first.back());
    std::vector<std::uint32_t> at(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            vertex_triangles[at[mesh.triangles[i][k]]++] = static_cast<std::uint32_t>(i);
        }
    }
    std::vector<layout::VertexData> data;
    data.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        data.push_back({octahedral_from_vector(mesh.normals[i]), mesh.uvs[i], first[i],
                        first[i + 1] - first[i], mesh.vertex_object[i],
                        mesh.colours.empty() ? 0xffffffffU : packed_colour(mesh.colours[i])});
    }
    vertex_data_ = Buffer::from<layout::VertexData>("vertex data", data);
    vertex_triangles_ = Buffer::from<std::uint32_t>("vertex triangles", vertex_triangles);
}

}  // namespace raybundle
