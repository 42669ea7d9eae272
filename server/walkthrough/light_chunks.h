// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "walkthrough/vertex_light.h"

namespace raybundle {

/// Triangles of one material that are drawn at once, with the light at their vertices; all arrays
/// but `indices` have an element a vertex, or are empty.
struct LightChunk {
    static constexpr std::size_t most_vertices = 65'535;  ///< 16-bit indices, without the restart

    std::uint32_t material = 0;
    std::uint32_t object = 0;  ///< index, where chunks are cut by object
    bool two_sided = false;    ///< `back` has light; otherwise backs are black
    glm::vec3 emission{0.0F};  ///< cd/m²; where `emissions` is empty
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;       ///< unit, or 0
    std::vector<glm::vec2> uvs;           ///< of the base colour texture, where it has one
    std::vector<glm::vec3> colours;       ///< factors of the base colour, linear, 0 to 1
    std::vector<glm::vec3> front;         ///< irradiance, lx
    std::vector<glm::vec3> back;          ///< likewise
    std::vector<glm::vec3> emissions;     ///< cd/m², where it differs from triangle to triangle
    std::vector<std::uint32_t> vertices;  ///< of the mesh
    std::vector<std::uint32_t>
        emission_triangles;              ///< of the mesh, as `emissions`; or a single one
    std::vector<std::uint16_t> indices;  ///< 3 a triangle, counter-clockwise from the front
};

/// By material: few chunks. By object, too: each can be moved, and whatever shines by a texture has
/// emission of its own at each vertex, even while it is dark.
enum class ChunkGroups { by_material, by_object };

/// Cuts a mesh into chunks, ordered by material.
std::vector<LightChunk> make_light_chunks(const Scene& scene, const PatchMesh& mesh,
                                          const VertexLight& light,
                                          ChunkGroups groups = ChunkGroups::by_material);

}  // namespace raybundle
