// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/light_chunks.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace raybundle {

namespace {

/// Triangles with one material and as many sides.
using Group = std::vector<std::uint32_t>;

class ChunkBuilder {
  public:
    ChunkBuilder(const Scene& scene, const PatchMesh& mesh, const VertexLight& light,
                 ChunkGroups cut)
        : scene_(scene),
          mesh_(mesh),
          light_(light),
          cut_(cut),
          positions_(world_positions(scene, mesh)),
          normals_(world_normals(scene, mesh)),
          local_(mesh.positions.size(), none) {}

    std::vector<LightChunk> build() {
        for (const Group& group : groups()) {
            add(group);
        }
        return std::move(chunks_);
    }

  private:
    static constexpr std::uint32_t none = 0xffffffffU;

    [[nodiscard]] bool two_sided(std::uint32_t triangle) const {
        return mesh_.back_side[triangle] != PatchMesh::no_patch;
    }

    [[nodiscard]] std::uint32_t object_of(std::uint32_t triangle) const {
        return cut_ == ChunkGroups::by_object ? mesh_.vertex_object[mesh_.triangles[triangle].x]
                                              : 0U;
    }

    [[nodiscard]] std::vector<Group> groups() const {
        std::map<std::tuple<std::uint32_t, bool, std::uint32_t>, Group> groups;
        for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
            groups[{mesh_.triangle_material[t], two_sided(t), object_of(t)}].push_back(t);
        }
        std::vector<Group> result;
        result.reserve(groups.size());
        for (auto& [key, group] : groups) {
            result.push_back(std::move(group));
        }
        return result;
    }

    [[nodiscard]] bool shines_by_texture(std::uint32_t triangle) const {
        return cut_ == ChunkGroups::by_object &&
               scene_.materials[mesh_.triangle_material[triangle]].emission_texture.texture >= 0;
    }

    void add(const Group& group) {
        const glm::vec3 emission = mesh_.emission[group.front()];
        own_emission_ = shines_by_texture(group.front()) ||
                        std::any_of(group.begin(), group.end(),
                                    [&](std::uint32_t t) { return mesh_.emission[t] != emission; });
        begin(group.front());
        for (const std::uint32_t triangle : group) {
            if (chunks_.back().positions.size() + 3 > LightChunk::most_vertices) {
                end();
                begin(triangle);
            }
            add_triangle(triangle);
        }
        end();
    }

    void begin(std::uint32_t triangle) {
        LightChunk& chunk = chunks_.emplace_back();
        chunk.material = mesh_.triangle_material[triangle];
        chunk.object = object_of(triangle);
        chunk.two_sided = two_sided(triangle);
        chunk.emission = own_emission_ ? glm::vec3(0.0F) : mesh_.emission[triangle];
        if (!own_emission_) {
            chunk.emission_triangles.push_back(triangle);
        }
    }

    void end() {
        for (const std::uint32_t vertex : used_) {
            local_[vertex] = none;
        }
        used_.clear();
    }

    void add_triangle(std::uint32_t triangle) {
        std::array<std::uint32_t, 3> v = {mesh_.triangles[triangle].x, mesh_.triangles[triangle].y,
                                          mesh_.triangles[triangle].z};
        const glm::mat3 world(scene_.objects[mesh_.vertex_object[v[0]]].world_from_object());
        if (glm::determinant(world) < 0.0F) {
            std::swap(v[1], v[2]);  // mirrored
        }
        for (const std::uint32_t vertex : v) {
            chunks_.back().indices.push_back(static_cast<std::uint16_t>(index_of(vertex)));
            if (own_emission_) {
                chunks_.back().emissions.push_back(mesh_.emission[triangle]);
                chunks_.back().emission_triangles.push_back(triangle);
            }
        }
    }

    /// In the chunk; emission that differs between triangles keeps their corners apart.
    std::uint32_t index_of(std::uint32_t vertex) {
        if (!own_emission_ && local_[vertex] != none) {
            return local_[vertex];
        }
        const auto index = static_cast<std::uint32_t>(chunks_.back().positions.size());
        local_[vertex] = index;
        used_.push_back(vertex);
        add_vertex(vertex);
        return index;
    }

    void add_vertex(std::uint32_t vertex) {
        LightChunk& chunk = chunks_.back();
        chunk.vertices.push_back(vertex);
        chunk.positions.push_back(positions_[vertex]);
        chunk.normals.push_back(normals_[vertex]);
        const TextureSlot& slot = scene_.materials[chunk.material].base_colour_texture;
        if (slot.texture >= 0) {
            chunk.uvs.emplace_back(slot.uv_from_mesh_uv * glm::vec3(mesh_.uvs[vertex], 1.0F));
        }
        if (!mesh_.colours.empty()) {
            chunk.colours.push_back(mesh_.colours[vertex]);
        }
        chunk.front.push_back(light_.front[vertex]);
        if (chunk.two_sided) {
            chunk.back.push_back(light_.back[vertex]);
        }
    }

    const Scene& scene_;
    const PatchMesh& mesh_;
    const VertexLight& light_;
    const ChunkGroups cut_;
    std::vector<glm::vec3> positions_, normals_;
    std::vector<std::uint32_t> local_;  // index in the chunk
    std::vector<std::uint32_t> used_;
    std::vector<LightChunk> chunks_;
    bool own_emission_ = false;
};

}  // namespace

std::vector<LightChunk> make_light_chunks(const Scene& scene, const PatchMesh& mesh,
                                          const VertexLight& light, ChunkGroups groups) {
    return ChunkBuilder(scene, mesh, light, groups).build();
}

}  // namespace raybundle
