// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "zones/zone_levels.h"

namespace raybundle {

/// Light of a zone by two independent means, radiance units m²: the one that was kept over the last
/// change, and the one of the iterations since.
struct ZoneMeans {
    glm::dvec3 kept{0.0};
    glm::dvec3 since{0.0};
    double since_weight = 0.0;  ///< samples that the latter is worth
    double area = 0.0;          ///< m²
    /// Mean of q / (q + DIFFERENCE_UNIT) over patches with both means. q: squared difference of the
    /// means, divided by its variance if samples had a relative deviation of 1. Negative: no patch
    /// has both.
    double bounded_difference = -1.0;
    bool loose = false;  ///< has no level of its own
};

/// How far the kept mean of a zone's patches is believed.
struct KeptLevel {
    glm::dvec3 scale{1.0};  ///< factor of it
    double limit = 1e30;    ///< samples that it is worth at most
    /// Squared relative deviation of samples of its patches from their means, estimated from the
    /// difference of both means in most patches.
    double sample_variance = 0.16;
    /// The change has put out nearly all light of the zone: its iterate starts from darkness, since
    /// the distribution of the former light would last longer than a new solve takes.
    bool anew = false;
};

/// Squared relative deviation of samples whose normally distributed differences have this mean of
/// q / (q + unit), see ZoneMeans::bounded_difference.
double variance_of_samples(double bounded_difference, double unit);

/// Judges the light that has been kept over a change. Both means estimate the same light. Where
/// their difference, summed over a zone, exceeds its noise, the kept mean has an error, which
/// bounds its weight. Directly after a change the flux that enters the zone (ZoneLevels) shows the
/// same at once, and the level of the kept mean follows it.
class KeptLight {
  public:
    /// A change has been worked in, as far as its special phase has found it.
    void begin() {
        levels_.clear();
        doubt_ = 0.0;
    }
    [[nodiscard]] bool judged() const { return !levels_.empty(); }
    /// After each solve() of the levels.
    const std::vector<KeptLevel>& judge(std::span<const ZoneMeans> means, const ZoneLevels& levels);

    /// Largest relative error (two standard deviations) of what is served of a zone whose kept
    /// light was off by more than 20 %, so that new light has taken its place; 0 where there is no
    /// such zone of at least 2 % of all surfaces and light, 1 where nothing is known of it yet.
    [[nodiscard]] double doubt() const { return doubt_; }

  private:
    void find_doubt(std::span<const ZoneMeans> means, const ZoneLevels& levels);

    double doubt_ = 0.0;
    std::vector<KeptLevel> levels_;  // empty: nothing has been judged since the change
};

}  // namespace raybundle
