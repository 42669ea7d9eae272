// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// Area of a side where its object stands in the scene, m².
double world_area(const Scene& scene, const PatchMesh& mesh, std::size_t side);
/// The same where a matrix would place its object.
double area_at(const glm::mat4& world_from_object, const PatchMesh& mesh, std::size_t side);
/// Area of all sides of a patch there, m².
double patch_area(const Scene& scene, const PatchMesh& mesh, std::uint32_t patch);

}  // namespace raybundle
