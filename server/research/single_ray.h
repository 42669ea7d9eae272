// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/albedo_tables.h"
#include "reference/ray_scene.h"
#include "reference/sampling/incoming_sample.h"
#include "reference/sampling/light_sampling.h"
#include "reference/sampling/random.h"

namespace raybundle {

/// Single-ray transport (ch. 4.2): a ray carries a share of the scene's power from a random point
/// into a random direction, drawn in proportion to the power that leaves there, to the one point it
/// hits. The first ray of a particle leaves an emitting patch chosen by its power, later ones leave
/// the point last hit with the probability of its albedo, so that all rays carry about the same.
///
/// Ch. 4.2 averages the iterates L(m) = Le + T* L(m-1). That average starts dark, and a ray that
/// goes on from the last point carries 1 + a times the power of the one before. As the same chapter
/// notes, the iteration is a sequence of random walks; here each walk by itself is an unbiased
/// sample of the whole series Le + T Le + T^2 Le + ... Nothing is lost by that: shooting random
/// walks and stochastic iteration from patch to patch have about the same variance per ray
/// (Bekaert 1999, "Hierarchical and Stochastic Algorithms for Radiosity", ch. 6), but walks go on
/// from the point that was hit, so that no light is spread over patches and any BRDF will do.
///
/// Walks go on by the BRDF, glossy or not, so that irradiance is right whatever reflects; what a
/// glossy patch reflects is kept as ch. 7.2 does: a main part, which the irradiance gives, and one
/// random IncomingSample per batch for the rest. It is the picture alone that needs it.
///
/// The particles form independently randomised batches, each evenly spread over emitters, points
/// and directions; batches give the standard errors.
class SingleRay {
  public:
    static constexpr std::uint32_t batches = 16;
    static constexpr std::uint32_t particles_per_iteration = 1U << 14U;
    static constexpr std::uint32_t particles_per_batch = particles_per_iteration / batches;

    SingleRay(const RayScene& scene, const LightSampling& lights, std::uint64_t seed);

    /// Follows particles_per_iteration more particles. The result depends on the seed and the
    /// number of iterations alone, not on the number of threads.
    void iterate();

    [[nodiscard]] std::uint64_t iterations() const { return iterations_; }
    [[nodiscard]] std::uint64_t rays() const { return rays_; }
    /// Mean irradiance of a patch over its area, lx.
    [[nodiscard]] glm::dvec3 irradiance(std::uint32_t patch) const;
    /// The same from the particles of one batch.
    [[nodiscard]] glm::dvec3 batch_irradiance(std::uint32_t patch, std::uint32_t batch) const;
    /// Standard error of irradiance(), lx.
    [[nodiscard]] glm::dvec3 standard_error(std::uint32_t patch) const;

    /// Whether any surface is glossy: only then are incoming samples kept.
    [[nodiscard]] bool glossy() const { return tables_.glossy(); }
    [[nodiscard]] const AlbedoTables& tables() const { return tables_; }
    /// What a glossy patch has received from the particles of a batch since the last restart;
    /// power as flux, per unit of own area of the ray scene.
    [[nodiscard]] const IncomingSample& incoming(std::uint32_t patch, std::uint32_t batch) const {
        return incoming_[index(patch, batch)];
    }
    /// Forgets the incoming samples, for independent new ones.
    void restart_incoming();

    [[nodiscard]] std::size_t bytes() const {
        return power_.size() * sizeof(glm::dvec3) + incoming_.size() * sizeof(IncomingSample);
    }

  private:
    [[nodiscard]] std::size_t index(std::uint32_t patch, std::uint32_t batch) const {
        return std::size_t{batch} * scene_.mesh().side_count() + patch;
    }
    void receive(const SurfacePoint& point, const Scattering& scattering, std::uint32_t batch,
                 const glm::dvec3& power, const IncomingLight& light, PixelSampler& sampler);
    std::uint64_t follow_batch(std::uint32_t batch);
    std::uint64_t follow_particle(std::uint32_t batch, PixelSampler& sampler);

    const RayScene& scene_;
    const LightSampling& lights_;
    std::uint64_t seed_;
    std::uint64_t iterations_ = 0;
    std::uint64_t rays_ = 0;
    AlbedoTables tables_;
    std::vector<glm::dvec3> power_;  // received, lm per unit of area; [batch * patches + patch]
    std::vector<IncomingSample> incoming_;  // the same order; empty without glossy surfaces
};

}  // namespace raybundle
