// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// What stands around somebody, by cells: enough to walk some metres without asking again.
struct WalkMap {
    static constexpr int columns = 64;     ///< along x and along z
    static constexpr int layers = 64;      ///< bits of a column
    static constexpr float cell = 0.1F;    ///< m, width of a column
    static constexpr float layer = 0.05F;  ///< m
    static constexpr float below = 2.4F;   ///< m, from the eye down to the lowest layer

    glm::vec3 origin{0.0F};  ///< corner of the least x, y and z, m, world space
    /// Column at z * columns + x; bit k: something is in the k-th layer from below.
    std::vector<std::uint64_t> occupied;
    /// Height of what is straight below the eye, m, however far; empty where nothing is.
    std::optional<float> floor;
};

/// The surroundings of an eye, objects at their present places. Whoever walks goes through doors.
/// Surfaces as thin as glass count, of either side.
WalkMap make_walk_map(const Scene& scene, const glm::vec3& eye);

/// The same with objects at other places, world from object for each. Of the scene it reads nothing
/// that changes while it is shown.
WalkMap make_walk_map(const Scene& scene, std::span<const glm::mat4> worlds, const glm::vec3& eye);

/// Places of a scene's objects now.
std::vector<glm::mat4> object_places(const Scene& scene);

}  // namespace raybundle
