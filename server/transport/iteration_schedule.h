// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "bundle/low_discrepancy.h"
#include "gpu/layouts.h"

namespace raybundle {

enum class Strategy { layered, plane, perspective };

/// Probabilities of the strategies (ch. 6.2): the densities of all receivers use the same numbers.
struct StrategyProbabilities {
    float layered = 0.3F;      ///< P1
    float plane = 0.0F;        ///< P2
    float perspective = 0.7F;  ///< P3
};

/// The random numbers of one iteration.
struct IterationSample {
    Strategy strategy = Strategy::perspective;
    unsigned batch = 0;  ///< which of the interleaved batches it belongs to, for the error estimate
    glm::vec4 shooter_numbers{0.0F};  ///< perspective: see solution_shooters.comp
    double row_phase = 0.0;           ///< which pixel rows sum for the patches, [0, 1)
    double angle = 0.0;               ///< of the bundle about its z axis, radians
    glm::vec3 direction{0.0F, 0.0F,
                        1.0F};  ///< parallel: uniform over half of the sphere, or all of it
    double plane = 0.0;         ///< where the plane splits the scene, share of R, [0, 1)
    glm::vec2 shift{0.0F};      ///< of the samples in their pixels, [0, 1)
    float faces = 0.0F;         ///< perspective: see choose_faces()
};

/// Hands out iterations: one low-discrepancy sequence per strategy, dealt out to interleaved
/// batches. Batches with a randomisation of their own would be independent, but cost much of what
/// the sequences bring (measured on the Cornell box, 512x512, true relRMSE after 3 and 10 s: 10.0
/// and 5.4 %, dealt out 5.8 and 3.5 %); as it is, the variance between batches says somewhat too
/// much. No clock and no state beyond counters, so a seed always gives the same sequence.
class IterationSchedule {
  public:
    /// shuffled: perspective samples come in an order that is random within blocks of
    /// shuffle_length. What a glossy patch sends depends on what it has received last; in the
    /// order of a Halton sequence the same shooter would always come after the same other one.
    /// planes_per_direction: plane bundles in a row that share a direction, their planes spread
    /// evenly over the scene.
    IterationSchedule(std::uint64_t seed, const StrategyProbabilities& probabilities,
                      bool shuffled = false, unsigned planes_per_direction = 1);

    IterationSample next();
    void set_probabilities(const StrategyProbabilities& probabilities) {
        probabilities_ = probabilities;
    }
    static constexpr unsigned shuffle_length = 32;

  private:
    unsigned next_batch();
    std::uint64_t next_perspective();
    static void sample_window(IterationSample& sample, const RandomisedHalton& numbers,
                              std::uint64_t k);
    void sample_shooter(IterationSample& sample, std::uint64_t k) const;
    void sample_plane(IterationSample& sample, std::uint64_t k) const;

    StrategyProbabilities probabilities_;
    unsigned planes_per_direction_;
    std::uint64_t seed_;
    bool shuffled_;
    std::array<std::uint8_t, shuffle_length> order_{};
    RandomisedHalton numbers_, plane_numbers_;
    std::array<unsigned, BATCHES> batch_order_ = {0, 1, 2, 3, 4, 5, 6, 7};
    std::uint64_t iterations_ = 0, layered_ = 0, planes_ = 0, perspective_ = 0;
};

/// Uniform direction on the sphere from two numbers in [0, 1).
glm::vec3 uniform_direction(double u, double v);

}  // namespace raybundle
