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
    bool two_sided = false;    ///< `back` has light; otherwise backs are black
    glm::vec3 emission{0.0F};  ///< cd/m²; where `emissions` is empty
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;      ///< unit, or 0
    std::vector<glm::vec2> uvs;          ///< of the base colour texture, where it has one
    std::vector<glm::vec3> colours;      ///< factors of the base colour, linear, 0 to 1
    std::vector<glm::vec3> front;        ///< irradiance, lx
    std::vector<glm::vec3> back;         ///< likewise
    std::vector<glm::vec3> emissions;    ///< cd/m², where it differs from triangle to triangle
    std::vector<std::uint16_t> indices;  ///< 3 a triangle, counter-clockwise from the front
};

/// Cuts a mesh into chunks, ordered by material.
std::vector<LightChunk> make_light_chunks(const Scene& scene, const PatchMesh& mesh,
                                          const VertexLight& light);

}  // namespace raybundle
