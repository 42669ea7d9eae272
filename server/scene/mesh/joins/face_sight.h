// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "scene/mesh/joins/triangle_joins.h"
#include "scene/walk/world_rays.h"

namespace raybundle {

/// Whether faces see each other past what stands on them or between them. Usable by any number of
/// threads.
class FaceSight {
  public:
    /// lift: what is lower hides nothing, m. Throws std::bad_alloc.
    FaceSight(const Scene& scene, const JoinFaces& faces, double lift)
        : rays_(scene), faces_(faces), lift_(lift) {}

    /// Across the edge that both have in common; two-sided faces on both of their sides.
    [[nodiscard]] bool across(std::uint32_t a, std::uint32_t b) const;
    /// All of one the middle of the other, straight, likewise.
    [[nodiscard]] bool between(std::uint32_t a, std::uint32_t b) const;

  private:
    [[nodiscard]] glm::vec3 above(const JoinFace& face, const glm::dvec3& place, double side) const;
    [[nodiscard]] bool over(const glm::vec3& from, const glm::vec3& to, const glm::dvec3& edge,
                            const glm::dvec3& normals, bool flat, double side) const;
    [[nodiscard]] bool across(const JoinFace& a, const JoinFace& b, double side) const;
    [[nodiscard]] bool middle_seen(const JoinFace& face, const JoinFace& from, double side) const;

    WorldRays rays_;
    const JoinFaces& faces_;
    double lift_;
};

}  // namespace raybundle
