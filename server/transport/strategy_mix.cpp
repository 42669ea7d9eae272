// SPDX-License-Identifier: Apache-2.0
#include "transport/strategy_mix.h"

#include <algorithm>
#include <cmath>

#include "scene/light/environment.h"

namespace raybundle {

namespace {

constexpr unsigned interval = 64;              // bundles between two adaptations
constexpr double fewest_bundles = 4;           // of a strategy, to know its scatter
constexpr double least_share = 0.1;            // of either strategy
constexpr double towards_optimum = 1.0 / 3.0;  // share of the way from the start, of logarithms

}  // namespace

StrategyMix::StrategyMix(const StrategyProbabilities& start, bool adaptive)
    : start_(start),
      now_(start),
      adaptive_(adaptive && start.layered > 0.0F && start.perspective > 0.0F &&
                start.plane == 0.0F) {}

void StrategyMix::count(Strategy strategy, int bundles) {
    if (strategy == Strategy::layered || strategy == Strategy::perspective) {
        counted_[strategy == Strategy::perspective ? 1 : 0] += bundles;
        since_ += static_cast<unsigned>(bundles);
    }
}

bool StrategyMix::is_due() const {
    return adaptive_ && since_ >= interval;
}

void StrategyMix::forget() {
    counted_ = {};
    since_ = 0;
}

void StrategyMix::adapt(const std::array<double, 2>& scatter_sums) {
    const auto [layered, perspective] = counted_;
    since_ = 0;
    for (double& bundles : counted_) {
        bundles *= 0.5;
    }
    if (layered < fewest_bundles || perspective < fewest_bundles || !(scatter_sums[0] > 0.0) ||
        !(scatter_sums[1] > 0.0)) {
        return;
    }
    const double imbalance = std::log(scatter_sums[0] / layered / layered_bundle_cost) -
                             std::log(scatter_sums[1] / perspective);
    const auto log_odds = [](const StrategyProbabilities& p) {
        return std::log(static_cast<double>(p.layered) / static_cast<double>(p.perspective));
    };
    // The imbalance is that of the present odds. Half a step each time: it falls as they rise.
    const double wanted = log_odds(start_) + towards_optimum * imbalance;
    const double odds = std::exp(0.5 * (log_odds(now_) + wanted));
    const double share = std::clamp(odds / (1.0 + odds), least_share, 1.0 - least_share);
    now_.layered = static_cast<float>(share);
    now_.perspective = 1.0F - now_.layered;
}

namespace {
float least_layered(const Scene& scene) {
    if (has_sky(scene)) {
        return has_emitter(scene) ? 0.4F : 0.75F;
    }
    const bool patches_emit =
        std::any_of(scene.materials.begin(), scene.materials.end(),
                    [](const Material& m) { return m.emission != glm::vec3(0.0F); });
    return !scene.punctual_lights.empty() && !patches_emit ? 0.5F : 0.0F;
}
}  // namespace

StrategyProbabilities suited_to(const Scene& scene, StrategyProbabilities probabilities) {
    const float least = least_layered(scene);
    if (least == 0.0F || probabilities.layered == 0.0F || probabilities.perspective == 0.0F) {
        return probabilities;
    }
    probabilities.layered = std::max(probabilities.layered, least);
    if (has_sky(scene)) {
        probabilities.plane = 0.0F;  // their pixels cannot tell whether a line passes beside a room
    }
    probabilities.perspective = 1.0F - probabilities.layered - probabilities.plane;
    return probabilities;
}

std::string light_missed(const Scene& scene, const StrategyProbabilities& probabilities) {
    if (has_sky(scene) && probabilities.layered <= 0.0F && probabilities.plane <= 0.0F) {
        return "perspective bundles are shot from surfaces and carry no light of the sky, which "
               "lights nothing here; parallel bundles do";
    }
    return {};
}

}  // namespace raybundle
