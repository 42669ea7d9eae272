// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/scene.h"
#include "transport/iteration_schedule.h"

namespace raybundle {

/// Probabilities of the strategies over the age of a solution (ch. 6.3: perspective bundles spread
/// the light of the lamps first, parallel bundles refine it). A function of the iterations alone,
/// so that a seed gives the same solution on every machine; every sample is divided by the density
/// of the probabilities that it was drawn with, so changing them is unbiased.
class StrategyMix {
  public:
    /// The same probabilities at all times.
    explicit StrategyMix(const StrategyProbabilities& fixed) : first_(fixed), last_(fixed) {}
    /// From first to last over the ageing iterations.
    StrategyMix(const StrategyProbabilities& first, const StrategyProbabilities& last)
        : first_(first), last_(last) {}

    [[nodiscard]] StrategyProbabilities at(std::uint64_t iterations) const;

    static constexpr std::uint64_t ageing_iterations = 512;
    [[nodiscard]] const StrategyProbabilities& first() const { return first_; }
    [[nodiscard]] const StrategyProbabilities& last() const { return last_; }

  private:
    StrategyProbabilities first_, last_;
};

/// The mix of the combined method.
StrategyMix ageing_mix();
/// Only parallel bundles see the sky: a mix with more of them where a sky lights the scene, and
/// more yet where it does so alone. Mixes without one of layered and perspective stay as they are.
StrategyMix with_sky(const StrategyMix& mix, const Scene& scene);

}  // namespace raybundle
