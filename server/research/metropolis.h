// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/camera_rays.h"
#include "reference/measures/image_estimate.h"
#include "reference/path_tracer.h"
#include "research/primary_sample.h"

namespace raybundle {

/// Metropolis light transport in primary sample space (Kelemen et al. 2002), with path tracing as
/// the map from numbers to light. Chains visit points of the picture and paths in proportion to the
/// luminance they bring; every step adds both points that it considers, by their expected weights.
/// The mean luminance of the picture, which the chains cannot know, comes from the large steps,
/// which are independent of each other. Chains begin at one of many uniform points, chosen by its
/// luminance, so that they need no time to warm up (Veach, Guibas 1997).
///
/// Chains belong to batches, independent of each other, which give the standard errors.
class Metropolis {
  public:
    static constexpr std::uint32_t batches = 8;
    static constexpr std::uint32_t chains_per_batch = 8;
    static constexpr std::uint32_t candidates_per_batch = 4096;  ///< for the chains' beginnings
    static constexpr double large_step_share = 0.3;

    Metropolis(const PathTracer& tracer, const CameraRays& camera, std::uint64_t seed);

    /// About as many steps as pixels, the same number by every chain. The result depends on the
    /// seed and the number of iterations alone, not on the number of threads.
    void iterate();

    [[nodiscard]] std::uint64_t iterations() const { return iterations_; }
    [[nodiscard]] std::vector<glm::dvec3> picture() const;  ///< cd/m², row 0 at the top
    [[nodiscard]] std::uint64_t non_finite() const { return non_finite_; }  ///< paths dropped
    /// measured: pixels that count, row by row.
    [[nodiscard]] ImageError error(const std::vector<bool>& measured) const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    /// Light that one point of primary sample space brings.
    struct Contribution {
        std::size_t pixel = 0;
        glm::dvec3 radiance{0.0};
        double luminance = 0.0;
        bool finite = true;
    };
    struct Chain {
        PrimarySample sample;
        RandomStream decisions;
        Contribution current;
        // What its next steps have found, to be added in order of the chains.
        std::vector<Splat> splats;
        double luminance_sum = 0.0;
        std::uint64_t large_steps = 0;
        std::uint64_t dropped = 0;
    };
    struct Batch {
        std::vector<Chain> chains;
        std::vector<glm::dvec3> sums;  // of radiance/luminance, by pixel
        double luminance_sum = 0.0;    // over uniform points
        std::uint64_t uniform_points = 0;
        std::uint64_t steps = 0;
    };

    [[nodiscard]] Contribution contribution(PrimarySample& sample) const;
    [[nodiscard]] PrimarySample candidate(std::uint32_t batch, std::uint32_t index) const;
    void begin();
    void begin_batch(std::uint32_t index, const std::vector<double>& luminances);
    void advance(Chain& chain) const;
    void collect(Batch& batch);
    [[nodiscard]] glm::dvec3 batch_mean(const Batch& batch, std::size_t pixel) const;

    const PathTracer& tracer_;
    CameraRays camera_;
    std::uint64_t seed_;
    std::uint32_t steps_per_chain_;
    std::array<Batch, batches> batches_;
    std::uint64_t iterations_ = 0;
    std::uint64_t non_finite_ = 0;
};

}  // namespace raybundle
