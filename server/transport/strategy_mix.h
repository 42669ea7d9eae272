// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "scene/scene.h"
#include "transport/iteration_schedule.h"

namespace raybundle {

/// Time of a layered bundle in those of a perspective one. On llvmpipe 2.1 in the Cornell box, 2.8
/// in the living room, 1.7 and 2.5 in rooms with glass and below a sky (two cores, 400-pixel window
/// and 256-pixel hemicube); on an H100 2.4 in the Cornell box and 3.8 in the living room (800 and
/// 512 pixels). A number, since a clock would give every run another solution.
constexpr double layered_bundle_cost = 2.2;

/// Probabilities of the strategies (ch. 6.2) that follow what is measured: of layered and
/// perspective bundles those become more frequent whose contributions scatter more for what they
/// cost. Every sample is divided by the density of the probabilities that it was drawn with, so
/// changing them is unbiased.
///
/// With the one density of the balance heuristic no small shift of probability lowers variance
/// times cost where sigma_i^2 / c_i is the same for all strategies i: sigma_i^2 is the mean squared
/// deviation of a bundle from the solution, c_i its cost, and more of strategy i lowers the
/// variance by sigma_i^2 for each bundle. That holds for independent bundles and for patches; ours
/// come from low-discrepancy sequences, and pixels are what is looked at. So the odds go a third of
/// the way, as logarithms, from those of the start, which are good in most rooms.
class StrategyMix {
  public:
    /// adaptive: has no effect unless layered and perspective bundles are in use, and they alone:
    /// the scatter of plane bundles is not measured.
    StrategyMix(const StrategyProbabilities& start, bool adaptive);

    [[nodiscard]] const StrategyProbabilities& probabilities() const { return now_; }

    /// A bundle of the strategy was transferred, or undone; layered and perspective ones count.
    void count(Strategy strategy, int bundles = 1);
    [[nodiscard]] bool adaptive() const { return adaptive_; }
    /// Whether enough bundles were counted since the last adapt().
    [[nodiscard]] bool is_due() const;
    /// scatter_sums: of squared deviations over all bundles counted, those before the last adapt()
    /// with half of their weight: of layered, of perspective bundles. What was counted weighs half
    /// from now on.
    void adapt(const std::array<double, 2>& scatter_sums);
    /// The light has changed: nothing was counted.
    void forget();

  private:
    StrategyProbabilities start_, now_;
    bool adaptive_;
    std::array<double, 2> counted_{};  // layered, perspective
    unsigned since_ = 0;               // bundles, since adapt()
};

/// Where to start from. Only parallel bundles see the sky: more of them where a sky lights the
/// scene, and more yet where it does so alone. Of punctual lights bundles carry what surfaces
/// reflect, which is spread more evenly than what lamps send: half of the bundles are parallel ones
/// where there is nothing else. Probabilities without one of layered and perspective stay as they
/// are.
StrategyProbabilities suited_to(const Scene& scene, StrategyProbabilities probabilities);

/// Which light bundles of these kinds do not carry; empty: they carry all of it. Shooters stand on
/// surfaces, so that none of them sends light of the sky.
std::string light_missed(const Scene& scene, const StrategyProbabilities& probabilities);

}  // namespace raybundle
