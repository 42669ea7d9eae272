// SPDX-License-Identifier: Apache-2.0
// The scene of the tests of moves.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "oracle/scene_builder.h"
#include "transport/solver.h"

namespace raybundle {

constexpr std::uint32_t box_object = 1;

/// A lit room with a box on its floor that can be moved, object box_object.
SceneBuilder room_with_box(const glm::vec3& box_place);
/// Coarse bundles of one resolution for good.
SolverSettings quick_settings(std::uint64_t seed, const BundleResolution& resolution);
void iterate(Solver& solver, std::uint64_t count);
/// Moves the box and carries the special phase through.
void move_box(Solver& solver, const glm::vec3& place);
/// Root mean square difference over root mean square of the second, green channel.
double relative_difference(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b);

}  // namespace raybundle
