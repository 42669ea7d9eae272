// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "bundle/low_discrepancy.h"
#include "transport/strategy_probabilities.h"

namespace raybundle {

enum class Strategy { layered, plane, perspective, opening };

/// The random numbers of one iteration.
struct IterationSample {
    Strategy strategy = Strategy::perspective;
    glm::vec4 shooter_numbers{0.0F};  ///< perspective: see solution_shooters.comp
    glm::vec4 opening_numbers{0.0F};  ///< opening: which one, and where in it, [0, 1)
    double row_phase = 0.0;           ///< which pixel rows sum for the patches, [0, 1)
    double angle = 0.0;               ///< of the bundle about its z axis, radians
    glm::vec3 direction{0.0F, 0.0F,
                        1.0F};  ///< parallel: uniform over half of the sphere, or all of it
    double plane = 0.0;         ///< where the plane splits the scene, share of R, [0, 1)
    glm::vec2 shift{0.0F};      ///< of the samples in their pixels, [0, 1)
    float faces = 0.0F;         ///< perspective: see choose_faces()
};

/// Hands out iterations: one low-discrepancy sequence per strategy. Batches with a randomisation of
/// their own would be independent, but cost much of what the sequences bring (measured on the
/// Cornell box, 512x512, true relRMSE after 3 and 10 s: 10.0 and 5.4 % instead of 5.8 and 3.5 %);
/// as it is, the scatter of the samples says too much: view/error/error_interval.h. No clock and no
/// state beyond counters, so a seed always gives the same sequence.
class IterationSchedule {
  public:
    /// shuffled: for glossy scenes, whose patches reflect the light that they accepted last. In its
    /// own order a low-discrepancy sequence stays away from where it has just been: parallel
    /// bundles would hardly ever take light back where it came from, and lay several per cent too
    /// much of it elsewhere. So directions, strategies and shooters come in random order within
    /// blocks.
    /// planes_per_direction: plane bundles in a row that share a direction, their planes spread
    /// evenly over the scene.
    IterationSchedule(std::uint64_t seed, const StrategyProbabilities& probabilities,
                      bool shuffled = false, unsigned planes_per_direction = 1);

    static constexpr unsigned direction_block = 216;  ///< fills all strata of bases 2 and 3 evenly
    static constexpr unsigned shooter_block = 32;

    IterationSample next();
    void set_probabilities(const StrategyProbabilities& probabilities) {
        probabilities_ = probabilities;
    }

  private:
    /// Indices 1, 2, ... of a sequence; if they are shuffled, in random order within blocks.
    class Indices {
      public:
        Indices(std::uint64_t key, unsigned block) : key_(key), order_(block) {}
        std::uint64_t next();

      private:
        std::uint64_t key_;
        std::vector<std::uint16_t> order_;
        std::uint64_t count_ = 0;
    };

    static void sample_window(IterationSample& sample, const RandomisedHalton& numbers,
                              std::uint64_t k);
    void sample_shooter(IterationSample& sample, std::uint64_t k) const;
    void sample_plane(IterationSample& sample, std::uint64_t k) const;
    void sample_opening(IterationSample& sample, std::uint64_t k) const;

    StrategyProbabilities probabilities_;
    unsigned planes_per_direction_;
    RandomisedHalton numbers_, plane_numbers_, opening_numbers_;
    Indices strategies_, layered_, planes_, perspective_, openings_;
};

/// Uniform direction on the sphere from two numbers in [0, 1).
glm::vec3 uniform_direction(double u, double v);

}  // namespace raybundle
