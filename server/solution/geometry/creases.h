// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/mesh/patch_mesh.h"

namespace raybundle {

/// Per triangle a mask of its creases: bit k is set where the edge opposite to vertex k has no
/// neighbour in its object that goes on within 30 degrees, or where more than two triangles meet.
/// See shaders/scene/crease.glsl.
std::vector<std::uint32_t> find_creases(const PatchMesh& mesh);

}  // namespace raybundle
