// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "bundle/low_discrepancy.h"
#include "gpu/layouts.h"

namespace raybundle {

enum class Strategy { layered, perspective };

/// Probabilities of the strategies (ch. 6.2): the densities of all receivers use the same numbers.
struct StrategyProbabilities {
    float layered = 0.15F;      ///< P1
    float plane = 0.0F;         ///< P2
    float perspective = 0.85F;  ///< P3
};

/// The random numbers of one iteration.
struct IterationSample {
    Strategy strategy = Strategy::perspective;
    unsigned batch = 0;  ///< which of the independently randomised batches it belongs to
    glm::vec4 shooter_numbers{0.0F};        ///< perspective: see solution_shooters.comp
    unsigned row_phase = 0;                 ///< which pixel rows sum for the patches
    double angle = 0.0;                     ///< of the bundle about its z axis, radians
    glm::vec3 direction{0.0F, 0.0F, 1.0F};  ///< layered: uniform over the sphere
    glm::vec2 shift{0.0F};                  ///< layered: share of a window pixel
};

/// Hands out iterations: low-discrepancy numbers per strategy and batch, batches interleaved. No
/// clock and no state beyond counters, so a seed always gives the same sequence.
class IterationSchedule {
  public:
    IterationSchedule(std::uint64_t seed, const StrategyProbabilities& probabilities);

    IterationSample next();

  private:
    struct Batch {
        RandomisedHalton numbers;
        std::uint64_t iterations = 0;
        std::uint64_t layered = 0;
        std::uint64_t perspective = 0;
    };
    StrategyProbabilities probabilities_;
    std::array<Batch, BATCHES> batches_;
    std::uint64_t iterations_ = 0;
};

/// Uniform direction on the sphere from two numbers in [0, 1).
glm::vec3 uniform_direction(double u, double v);

}  // namespace raybundle
