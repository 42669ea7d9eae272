// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// Single rays against the triangles of a scene, objects at their initial places. Metres, world.
class WorldRays {
  public:
    struct Hit {
        float distance = std::numeric_limits<float>::infinity();
        std::uint32_t triangle = 0;  ///< index into Scene::triangles, where distance is finite
        bool front = false;          ///< of a side that has light
        glm::vec3 normal{0, 1, 0};   ///< geometric, unit, towards the ray's origin
        [[nodiscard]] bool met() const { return distance < std::numeric_limits<float>::infinity(); }
    };

    /// Throws std::bad_alloc where there is no memory for the tree.
    explicit WorldRays(const Scene& scene);
    ~WorldRays();
    WorldRays(const WorldRays&) = delete;
    WorldRays& operator=(const WorldRays&) = delete;

    /// What a ray meets first; direction: unit.
    [[nodiscard]] Hit trace(const glm::vec3& origin, const glm::vec3& direction) const;
    /// Whether anything is on the way between two points.
    [[nodiscard]] bool blocked(const glm::vec3& from, const glm::vec3& to) const;

  private:
    struct Tree;
    const Scene& scene_;
    std::unique_ptr<Tree> tree_;
};

}  // namespace raybundle
