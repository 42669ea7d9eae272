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
/// Area mean of the sides' normals, unit, object space; 0 where they cancel out.
glm::vec3 patch_normal(const PatchMesh& mesh, std::uint32_t patch);
/// Whether a side's normal is more than 14 degrees from that mean. Round things spread all that
/// they reflect: between surfaces such a patch is a Lambert surface of its mean albedo.
bool is_bent(const PatchMesh& mesh, std::uint32_t patch);
/// Metalness and roughness of every patch; empty where the mesh has none.
std::vector<glm::vec2> patch_metallic_roughness(const PatchMesh& mesh);

}  // namespace raybundle
