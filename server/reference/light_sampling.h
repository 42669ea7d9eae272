// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/directions.h"
#include "reference/discrete_distribution.h"
#include "reference/ray_scene.h"

namespace raybundle {

/// Light from a point chosen on the emitters or from the sky.
struct LightSample {
    glm::dvec3 direction{0.0};            ///< from the receiver, unit
    glm::dvec3 radiance{0.0};             ///< towards the receiver, cd/m², occlusion not included
    double density = 0.0;                 ///< of this direction, per solid angle, 1/sr
    std::optional<SurfacePoint> emitter;  ///< nothing: the sky
};

/// A random point and direction from which light sets out, with the power that a particle carries
/// from there: flux in cd/m² times own area, so that the mean over particles is the scene's flux.
struct EmittedParticle {
    std::optional<SurfacePoint> emitter;  ///< nothing: the sky, from `origin`
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0};  ///< unit
    glm::dvec3 power{0.0};
};

/// Random choice of light sources. Emitting patches are chosen by their power, with a defensive
/// share of 10 % by area so that no dim one is starved, and a point on them uniformly; the uniform
/// sky by the flux it could send into the scene.
class LightSampling {
  public:
    explicit LightSampling(const RayScene& scene);

    [[nodiscard]] bool empty() const { return emitters_.empty() && !(sky_probability_ > 0.0); }
    /// For next-event estimation; a direction of the sky by its cosine. receiver: frame about the
    /// normal whose cosine counts. choice and at: uniform random numbers.
    [[nodiscard]] std::optional<LightSample> sample(const SurfacePoint& from, const Frame& receiver,
                                                    double choice, const glm::dvec2& at) const;
    /// Whether the sample's light arrives.
    [[nodiscard]] bool arrives(const SurfacePoint& from, const LightSample& light) const;
    /// Density, 1/sr, with which sample() would have found the direction from a point to one that
    /// a ray has hit, or to the sky (hit is empty).
    [[nodiscard]] double density(const SurfacePoint& from, const Frame& receiver,
                                 const glm::dvec3& direction,
                                 const std::optional<SurfacePoint>& hit) const;

    /// Density with which a point of a patch is chosen, 1/own area.
    [[nodiscard]] double area_density(std::uint32_t patch) const {
        return density_per_area_[patch];
    }
    /// Densities of a line from the sky, as emit() draws it: of its direction, 1/sr, and of its
    /// place across it, 1/own area.
    [[nodiscard]] double sky_direction_density() const;
    [[nodiscard]] double sky_disc_density() const;

    /// For particles that are followed from the light. Must not be empty().
    [[nodiscard]] EmittedParticle emit(double choice, const glm::dvec2& at,
                                       const glm::dvec2& direction) const;

  private:
    [[nodiscard]] EmittedParticle emit_from_sky(const glm::dvec2& at,
                                                const glm::dvec2& direction) const;
    [[nodiscard]] std::optional<LightSample> sample_emitter(const SurfacePoint& from, double choice,
                                                            const glm::dvec2& at) const;

    const RayScene& scene_;
    std::vector<std::uint32_t> patches_;    // that emit
    DiscreteDistribution emitters_;         // over patches_
    std::vector<double> density_per_area_;  // of all patches, 1/area; 0: not chosen
    double sky_probability_ = 0.0;
    glm::dvec3 sky_;
};

}  // namespace raybundle
