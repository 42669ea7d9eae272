// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "reference/air_ways.h"
#include "reference/albedo_tables.h"
#include "reference/ray_scene.h"
#include "reference/sampling/light_sampling.h"
#include "reference/sampling/next_event.h"
#include "reference/sampling/random.h"
#include "reference/sampling/roulette.h"
#include "reference/sampling/russian_roulette.h"
#include "reference/scattering.h"
#include "reference/specular_walk.h"

namespace raybundle {

struct PathSettings {
    int max_bounces = raybundle::max_bounces;
    int certain_bounces = 3;      ///< before Russian roulette begins
    bool next_event = true;       ///< false: paths meet the light by themselves
    int first_light_samples = 1;  ///< for next-event estimation where a path begins
    Survival survival = Survival::throughput;
    double survival_probability = 0.5;  ///< of Survival::fixed, in (0, 1); see optimal_survival()
    Panes panes = Panes::block;         ///< for the light of punctual lights
};

/// A path at a surface, on its way from the eye to the lights.
struct PathEnd {
    SurfacePoint point;
    Scattering scattering;       ///< there, towards where the path came from
    glm::dvec3 throughput{1.0};  ///< of what it reflects that way
    int bounces = 0;             ///< before this one
    bool passed = false;         ///< a mirror or glass since the surface before
};

/// What a ray from the eye shows.
struct Seen {
    glm::dvec3 emitted{0.0};     ///< radiance without what is reflected, cd/m²
    std::optional<PathEnd> end;  ///< where the surface reflects
};

/// Path tracing (Kajiya 1986; ch. 2.4) with next-event estimation, which glass blocks: light that
/// comes through glass or from ideal mirrors is met by the paths themselves, that of punctual
/// lights behind glass not at all, unless the settings let it through thin panes. Light that a path
/// meets by itself and light that is sampled are weighted by the power heuristic.
///
/// Where the scene has a medium, paths collide with the air (distance sampling) and are scattered
/// by its phase function. Lamps with extent are sampled at every collision, punctual lights once
/// along every ray, the sky is met by chance. Inside of glass bodies there is no air.
class PathTracer {
  public:
    PathTracer(const RayScene& scene, const LightSampling& lights,
               const PathSettings& settings = {});

    /// Unbiased estimate of the radiance that arrives at a point in space (own space of the ray
    /// scene) against a unit direction, cd/m².
    [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& origin, const glm::dvec3& direction,
                                      Sampler& sampler) const;
    /// The same for irradiance: light that arrives at a surface point, lx, cosine included.
    [[nodiscard]] glm::dvec3 irradiance(const SurfacePoint& point, Sampler& sampler) const;

    /// Where a walk ends at a surface that reflects, as light between surfaces knows it; nothing
    /// where it does not.
    [[nodiscard]] std::optional<PathEnd> end_of(const SpecularWalk& walk, Sampler& sampler) const;

    /// radiance() without what the first surface, or the sky, sends straight to there of its own.
    [[nodiscard]] glm::dvec3 indirect(const glm::dvec3& origin, const glm::dvec3& direction,
                                      Sampler& sampler) const;
    /// The scene's air; nothing where it is clear.
    [[nodiscard]] const std::optional<AirWays>& air() const { return air_; }

    // The steps that radiance() is made of, in clear air.

    /// Follows a ray from the eye to the first surface that is neither mirror nor glass.
    [[nodiscard]] Seen see(const glm::dvec3& origin, const glm::dvec3& direction,
                           Sampler& sampler) const;
    /// Goes on to the next surface. Adds to `sum` the light that the surface left behind reflects
    /// without any other surface, times the throughput, cd/m². False where the path has ended.
    bool advance(PathEnd& end, glm::dvec3& sum, Sampler& sampler) const;
    /// What the path reflects at its end and all surfaces to come, times its throughput, cd/m².
    [[nodiscard]] glm::dvec3 reflected(PathEnd end, Sampler& sampler) const;

  private:
    [[nodiscard]] int light_samples(const PathEnd& end) const {
        return end.bounces == 0 ? settings_.first_light_samples : 1;
    }
    /// Where the surface transmits light diffusely, chooses whose light is followed: that of its
    /// own side, or that of the other one. Returns what to multiply it by.
    [[nodiscard]] double choose_side(SurfacePoint& point, Scattering& scattering,
                                     Sampler& sampler) const;
    [[nodiscard]] double survival_chance(const PathEnd& end) const;
    /// Of what a ray of that direction has met, without punctual lights.
    [[nodiscard]] glm::dvec3 emitted(const std::optional<SurfacePoint>& hit,
                                     const glm::dvec3& direction) const;

    /// A ray of a path through air, from a surface, a collision, or the eye.
    struct Flight {
        glm::dvec3 origin{0.0};
        glm::dvec3 direction{0.0};            ///< unit
        std::optional<SurfacePoint> surface;  ///< where it leaves one
        std::optional<Scattering> reflected;  ///< by which it was sampled
        std::optional<AirVertex> vertex;      ///< likewise in the air
        glm::dvec3 throughput{1.0};
        double density = 0.0;  ///< of the direction; 0: the eye's
        int light_samples = 0;
        int bounces = 0;
        bool passed = false;  ///< a mirror or glass since
        bool sends = true;    ///< what it meets first may send light of its own
    };
    static Flight from_eye(const glm::dvec3& origin, const glm::dvec3& direction);
    [[nodiscard]] glm::dvec3 fly(Flight flight, Sampler& sampler) const;
    bool collide(Flight& flight, double distance, glm::dvec3& sum, Sampler& sampler) const;
    bool arrive(Flight& flight, const SurfacePoint& hit, glm::dvec3& sum, Sampler& sampler) const;
    bool leave(Flight& flight, PathEnd& end, glm::dvec3& sum, Sampler& sampler) const;
    [[nodiscard]] glm::dvec3 sampled_light(const PathEnd& end, double lobe_samples,
                                           Sampler& sampler) const;
    [[nodiscard]] double weight_of_met(const Flight& flight,
                                       const std::optional<SurfacePoint>& hit) const;
    static bool survives(Flight& flight, double chance, Sampler& sampler);

    const RayScene& scene_;
    const LightSampling& lights_;
    PathSettings settings_;
    std::optional<AirWays> air_;
    std::optional<AlbedoTables> tables_;  // where Survival::albedo asks for them
};

}  // namespace raybundle
