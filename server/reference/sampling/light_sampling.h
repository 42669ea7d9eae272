// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/ray_scene.h"
#include "reference/sampling/directions.h"
#include "reference/sampling/discrete_distribution.h"
#include "reference/sampling/sky_distribution.h"

namespace raybundle {

/// Weight of a sample drawn with a density (above 0) that another technique draws with density
/// `other`: the power heuristic with exponent 2 (Veach, Guibas 1995, "Optimally Combining Sampling
/// Techniques"). Where one of the two is far better, as a light far away is sampled rather than
/// met by chance, it leaves the other one's noise out.
inline double power_heuristic(double density, double other) {
    const double ratio = other / density;
    return 1.0 / (1.0 + ratio * ratio);
}

/// Light from a point chosen on the emitters or from the sky.
struct LightSample {
    glm::dvec3 direction{0.0};            ///< from the receiver, unit
    glm::dvec3 radiance{0.0};             ///< towards the receiver, cd/m², occlusion not included
    double density = 0.0;                 ///< of this direction, per solid angle, 1/sr
    std::optional<SurfacePoint> emitter;  ///< nothing: the sky, or a punctual light
    /// Index into Scene::punctual_lights, or no_light. Then radiance is illuminance (lx) of a
    /// surface that faces the light, and density the probability of its choice.
    int punctual = no_light;
    std::optional<glm::dvec3> origin;  ///< of a punctual light that is not directional

    static constexpr int no_light = -1;

    /// Of the sample where another technique draws the direction with a density of `other`, 1/sr.
    /// None meets a punctual light.
    [[nodiscard]] double weight(double other) const {
        return punctual == no_light ? power_heuristic(density, other) : 1.0;
    }
};

/// A random point and direction from which light sets out, with the power that a particle carries
/// from there: flux in cd/m² times own area, so that the mean over particles is the scene's flux.
struct EmittedParticle {
    std::optional<SurfacePoint> emitter;  ///< nothing: from `origin`
    glm::dvec3 origin{0.0};
    int punctual = LightSample::no_light;  ///< the punctual light, else the sky
    bool distant = false;                  ///< it came from infinitely far away
    glm::dvec3 direction{0.0};             ///< unit
    glm::dvec3 power{0.0};
};

/// What a particle meets first; nothing: the sky.
std::optional<SurfacePoint> first_hit(const RayScene& scene, const EmittedParticle& particle);

/// Random choice of light sources. Emitting patches are chosen by their power, with a defensive
/// share of 10 % by area so that no dim one is starved, and a point on them uniformly; the uniform
/// sky by the flux it could send into the scene. Punctual lights get a share of the samples by
/// power too; particles set out from them by their flux, and surfaces choose them by the light that
/// each would bring were nothing in its way.
class LightSampling {
  public:
    explicit LightSampling(const RayScene& scene);

    [[nodiscard]] bool empty() const {
        return emitters_.empty() && !(sky_probability_ > 0.0) && punctual_.empty();
    }
    /// For next-event estimation; a direction of the sky half by its cosine, half by its radiance
    /// where that varies. receiver: frame about the normal whose cosine counts. choice and at:
    /// uniform random numbers.
    [[nodiscard]] std::optional<LightSample> sample(const SurfacePoint& from, const Frame& receiver,
                                                    double choice, const glm::dvec2& at) const;
    /// Whether the sample's light arrives.
    [[nodiscard]] bool arrives(const SurfacePoint& from, const LightSample& light) const;
    /// Share that arrives where thin panes let the light of punctual lights straight through.
    [[nodiscard]] glm::dvec3 arriving_share(const SurfacePoint& from,
                                            const LightSample& light) const;
    /// For next-event estimation by emitters alone; `from`: any point, its position counts.
    [[nodiscard]] std::optional<LightSample> sample_emitter(const SurfacePoint& from, double choice,
                                                            const glm::dvec2& at) const;
    /// Of sample_emitter(), 1/sr, where it is not occluded.
    [[nodiscard]] double emitter_density(const SurfacePoint& from, const glm::dvec3& direction,
                                         const SurfacePoint& emitter) const;
    [[nodiscard]] bool has_emitters() const { return !emitters_.empty(); }
    /// Density, 1/sr, with which sample() would have found the direction from a point to one that
    /// a ray has hit, or to the sky (hit is empty).
    [[nodiscard]] double density(const SurfacePoint& from, const Frame& receiver,
                                 const glm::dvec3& direction,
                                 const std::optional<SurfacePoint>& hit) const;

    /// Density with which a point of a patch is chosen, 1/own area.
    [[nodiscard]] double area_density(std::uint32_t patch) const {
        return density_per_area_[patch];
    }
    /// Probability with which emit() chooses a punctual light.
    [[nodiscard]] double punctual_probability(int light) const {
        return punctual_probability_ * choice_.probability(static_cast<std::size_t>(light));
    }
    /// Density, 1/sr, with which emit() draws a direction of a punctual light that has a position.
    [[nodiscard]] double punctual_direction_density(int light) const;
    /// Densities of a line from the sky, as emit() draws it: of its direction, 1/sr, and of its
    /// place across it, 1/own area.
    [[nodiscard]] double sky_direction_density() const;
    [[nodiscard]] double sky_disc_density() const;

    /// For particles that are followed from the light. Must not be empty().
    [[nodiscard]] EmittedParticle emit(double choice, const glm::dvec2& at,
                                       const glm::dvec2& direction) const;

  private:
    void choose_punctual_lights(double emitted);
    [[nodiscard]] EmittedParticle emit_from_sky(const glm::dvec2& at,
                                                const glm::dvec2& direction) const;
    struct ChosenLight {
        std::size_t index;  ///< into punctual_
        double probability;
    };
    struct Arrival {
        glm::dvec3 direction{0.0};    ///< from the receiver, unit; 0: it is at the light itself
        glm::dvec3 illuminance{0.0};  ///< of a surface that faces the light, lx
    };
    [[nodiscard]] Arrival arrival(const SurfacePoint& from, const PlacedLight& light,
                                  const glm::dvec2& at) const;
    [[nodiscard]] ChosenLight choose_punctual(const SurfacePoint& from, const Frame& receiver,
                                              double choice, const glm::dvec2& at) const;
    [[nodiscard]] std::optional<LightSample> sample_punctual(const SurfacePoint& from,
                                                             const Frame& receiver, double choice,
                                                             const glm::dvec2& at) const;
    [[nodiscard]] double sky_density(const Frame& receiver, const glm::dvec3& direction) const;
    [[nodiscard]] EmittedParticle emit_punctual(double choice, const glm::dvec2& at,
                                                const glm::dvec2& direction) const;
    [[nodiscard]] glm::dvec3 on_disc(const glm::dvec3& direction, const glm::dvec2& at) const;

    const RayScene& scene_;
    std::vector<std::uint32_t> patches_;    // that emit
    DiscreteDistribution emitters_;         // over patches_
    std::vector<double> density_per_area_;  // of all patches, 1/area; 0: not chosen
    double emitter_probability_ = 1.0;
    double sky_probability_ = 0.0;
    SkyDistribution sky_;
    std::vector<PlacedLight> punctual_;
    DiscreteDistribution choice_;  // over punctual_, by flux
    double punctual_probability_ = 0.0;
};

}  // namespace raybundle
