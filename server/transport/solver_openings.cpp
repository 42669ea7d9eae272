// SPDX-License-Identifier: Apache-2.0
// Bundles that start where the scene is open to the sky.
#include "transport/solver.h"

namespace raybundle {

/// Lines of openings are those of layered bundles, so that there is no place for them beside plane
/// ones, or none.
bool Solver::wants_openings() const {
    const StrategyProbabilities& others = mix_.probabilities();
    return settings_.openings && settings_.adapt_probabilities && !settings_.first_probabilities &&
           others.layered > 0.0F && others.perspective > 0.0F && others.plane == 0.0F &&
           scene_.has_sky() && !scene_.constant_radiance();
}

/// Old openings are as right as others, and hardly less useful: new ones can wait for the end of a
/// drag.
void Solver::refresh_openings() {
    constexpr std::uint64_t rest = 64;  // iterations
    if (wants_openings() && openings_change_ != changes_ &&
        (!openings_change_ || since_change_ >= rest)) {
        openings_ = zones_.find_openings();
        openings_change_ = changes_;
    }
}

/// From a random point of an opening that is chosen by its share.
void Solver::run_opening(const IterationSample& sample, const TransferSettings& settings,
                         std::span<BundleReceiver* const> receivers) {
    const std::vector<SkyOpening>& openings = openings_.openings;
    std::size_t chosen = 0;
    for (float left = sample.opening_numbers.x - openings[0].share;
         left >= 0.0F && chosen + 1 < openings.size();) {
        left -= openings[++chosen].share;
    }
    const SkyOpening& opening = openings[chosen];
    BundleFrame frame = make_frame(opening.corner + sample.opening_numbers.y * opening.edges[0] +
                                       sample.opening_numbers.z * opening.edges[1] +
                                       sample.opening_numbers.w * opening.edges[2],
                                   opening.inward, static_cast<float>(sample.angle));
    frame.pixel_shift = sample.shift - 0.5F;
    transfer().opening(frame, settings, receivers);
}

}  // namespace raybundle
