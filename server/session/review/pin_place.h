// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "session/review/review_board.h"

namespace raybundle {

/// Puts a pin on a side of the mesh, where that is nearest to `position` (world, m).
void put_on(const Scene& scene, const PatchMesh& mesh, std::uint32_t side,
            const glm::vec3& position, Pin& pin);

/// The side of the mesh that a pin lies on: it is looked for again where the mesh has grown.
/// Nothing where it lies on no surface, or its object is not there. A pin of a journal that has
/// only the side's number gets its place.
std::optional<std::uint32_t> side_of(const Scene& scene, const PatchMesh& mesh, Pin& pin);

}  // namespace raybundle
