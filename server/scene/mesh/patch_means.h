// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/mesh/patch_mesh.h"

namespace raybundle {

/// Area of a side in object space, m².
float side_area(const PatchMesh& mesh, std::uint32_t side);

/// Area means over the sides of every patch, of what sides have.
std::vector<glm::vec3> patch_means(const PatchMesh& mesh, const std::vector<glm::vec3>& of_sides);
/// `of_sides` may be empty: so is the result.
std::vector<float> patch_means(const PatchMesh& mesh, const std::vector<float>& of_sides);
/// Metalness and roughness of every patch; empty where the mesh has none.
std::vector<glm::vec2> patch_metallic_roughness(const PatchMesh& mesh);

}  // namespace raybundle
