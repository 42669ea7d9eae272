// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "trace/air/air_lights.h"

namespace raybundle {

/// Light that the air along a ray scatters against it, cd/m², by where it has come from last.
struct AirEstimate {
    glm::dvec3 lamps{0.0};     ///< lamps and sky, however often the air has scattered it
    glm::dvec3 surfaces{0.0};  ///< what surfaces reflect

    [[nodiscard]] glm::dvec3 all() const { return lamps + surfaces; }
};

/// Single paths through air that scatters, from where its light is wanted: lamps are sampled along
/// each ray (equiangular, Kulla and Fajardo 2012), and a path that is scattered goes on until it
/// leaves the air or meets a surface, whose radiance the solution knows. Unbiased for the
/// surfaces' radiance as it is given.
class AirPaths {
  public:
    /// What air, surfaces and lamps are now. All must outlive it.
    struct Parts {
        const Scene& scene;  ///< its sky
        const Medium& medium;
        Bounds box;  ///< of the air, in the space of the rays
        const AirScene& surfaces;
        const AirLights& lights;
        std::span<const glm::vec3> reflected;  ///< of patches, cd/m²; empty: none
    };
    explicit AirPaths(const Parts& parts);

    /// One estimate along a ray, `end` m at most. direction: unit.
    [[nodiscard]] AirEstimate along(const glm::vec3& origin, const glm::vec3& direction, double end,
                                    AirRandom& random) const;
    /// The part of a ray in the air.
    [[nodiscard]] WayInBox way(const glm::vec3& origin, const glm::vec3& direction,
                               double end) const;
    /// How much of what surfaces send it takes away, 0..1.
    [[nodiscard]] double opacity(const WayInBox& way) const {
        return -std::expm1(-medium_.extinction * way.length());
    }
    [[nodiscard]] const AirScene& surfaces() const { return parts_.surfaces; }

  private:
    [[nodiscard]] glm::dvec3 lamps_along(const glm::vec3& origin, const glm::vec3& direction,
                                         const WayInBox& way, AirRandom& random) const;
    [[nodiscard]] glm::dvec3 arriving(const AirLight& light, const glm::vec3& at,
                                      const glm::vec3& eye_ray, AirRandom& random) const;
    struct Place {
        double distance = 0.0, density = 0.0;
    };
    [[nodiscard]] Place place_towards(const glm::vec3& light, const glm::vec3& origin,
                                      const glm::vec3& direction, const WayInBox& way,
                                      double u) const;
    [[nodiscard]] Place place_by_extinction(const WayInBox& way, double u) const;

    Parts parts_;
    const Medium& medium_;
    glm::dvec3 low_, high_;
};

}  // namespace raybundle
