// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// Irradiance at the vertices of a mesh, lx: the area-weighted mean over the patches round each, as
/// shaders/view/view_vertex_irradiance.comp has it. Interpolated over triangles it has no seams.
struct VertexLight {
    std::vector<glm::vec3> front, back;  ///< back: 0 where no triangle has one
};

/// world: places of the mesh's vertices, m. irradiance: of patches, lx, as
/// RadianceStore::read_irradiance().
VertexLight light_at_vertices(const PatchMesh& mesh, std::span<const glm::vec3> world,
                              std::span<const glm::vec4> irradiance);

/// The vertices in the world, objects where the scene has them.
std::vector<glm::vec3> world_positions(const Scene& scene, const PatchMesh& mesh);
/// Their normals, unit; 0 where there are none.
std::vector<glm::vec3> world_normals(const Scene& scene, const PatchMesh& mesh);

}  // namespace raybundle
