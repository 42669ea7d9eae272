// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "session/review/review_board.h"

namespace raybundle {

/// A side of the mesh and how far a point is from it, m.
struct NearSide {
    std::uint32_t side = 0;
    float distance = 0.0F;
};

/// Which side a point lies on that somebody has seen: `named` where it does so within `rounding`
/// (m), else the nearest side of what is there; of a surface with two sides the one that `eye`
/// sees, the front without an eye. point, eye: world, m. Nothing where no object is there.
std::optional<NearSide> side_near(const Scene& scene, const PatchMesh& mesh, std::uint32_t named,
                                  const glm::vec3& point, const std::optional<glm::vec3>& eye,
                                  float rounding);

/// Puts a pin on a side of the mesh at `position` (world, m), and says so in its message.
void put_on(const Scene& scene, const PatchMesh& mesh, std::uint32_t side,
            const glm::vec3& position, Pin& pin);

/// The side of the mesh that a pin lies on: it is looked for again where the mesh has grown.
/// Nothing where it lies on no surface, or its object is not there. A pin of a journal that has
/// only the side's number gets its place.
std::optional<std::uint32_t> side_of(const Scene& scene, const PatchMesh& mesh, Pin& pin);

}  // namespace raybundle
