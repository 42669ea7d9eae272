// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/ray_scene.h"
#include "reference/sampling/discrete_distribution.h"
#include "reference/sampling/light_sampling.h"
#include "reference/sampling/next_event.h"
#include "reference/sampling/random.h"

namespace raybundle {

/// Where a path is in the air, and what it goes on with.
struct AirVertex {
    glm::dvec3 position{0.0};
    glm::dvec3 along{0.0};  ///< unit, of the ray that came here from the eye
};

/// The air of a scene to paths from the eye, in the own space of its rays: what is left of light on
/// its way, where paths collide, and the light that lamps send to there. Exists where the scene has
/// a medium.
class AirWays {
  public:
    /// lights and scene must outlive it.
    AirWays(const RayScene& scene, const LightSampling& lights, Panes panes);

    /// The part of a ray that lies in the air. hit: what it meets.
    [[nodiscard]] WayInBox way(const glm::dvec3& origin, const glm::dvec3& direction,
                               const std::optional<SurfacePoint>& hit) const;
    [[nodiscard]] double transmittance(double length) const;
    /// Of the straight way between two points.
    [[nodiscard]] double transmittance_between(const glm::dvec3& a, const glm::dvec3& b) const;
    /// Of a way that leaves the scene.
    [[nodiscard]] double transmittance_to_sky(const glm::dvec3& from,
                                              const glm::dvec3& direction) const;
    /// What arrives of a light sample after all air between.
    [[nodiscard]] double transmittance_of(const glm::dvec3& from, const LightSample& light) const;

    /// Where a ray collides, from its origin; nothing where it gets to the end of the way.
    [[nodiscard]] std::optional<double> collision(const WayInBox& way, double u) const;
    [[nodiscard]] const Medium& medium() const { return medium_; }

    /// Estimate of the light of punctual lights that the air along a ray scatters back against it
    /// once, cd/m². One light, one place (equiangular towards the light, Kulla and Fajardo 2012).
    [[nodiscard]] glm::dvec3 punctual(const glm::dvec3& origin, const glm::dvec3& direction,
                                      const WayInBox& way, Sampler& sampler) const;
    /// Estimate of what emitters send to a vertex and is scattered there, cd/m², by one point of
    /// theirs, weighted against directions by the phase function.
    [[nodiscard]] glm::dvec3 emitters(const AirVertex& at, Sampler& sampler) const;
    /// Density, 1/sr, with which emitters() finds what a ray from the vertex has hit.
    [[nodiscard]] double emitter_density(const AirVertex& at, const glm::dvec3& direction,
                                         const std::optional<SurfacePoint>& hit) const;

  private:
    struct Place {
        double distance = 0.0;
        double density = 0.0;  // per own length
    };
    [[nodiscard]] Place place_towards(const glm::dvec3& light, const glm::dvec3& origin,
                                      const glm::dvec3& direction, const WayInBox& way,
                                      double u) const;
    [[nodiscard]] Place place_by_extinction(const WayInBox& way, double u) const;
    [[nodiscard]] glm::dvec3 reaching(const PlacedLight& light, const glm::dvec3& at,
                                      const glm::dvec2& u, glm::dvec3& to_light) const;

    const RayScene& scene_;
    const LightSampling& lights_;
    Panes panes_;
    Medium medium_;
    double extinction_;  // 1/own length
    glm::dvec3 low_, high_;
    std::vector<PlacedLight> punctual_;
    DiscreteDistribution choice_;
};

}  // namespace raybundle
