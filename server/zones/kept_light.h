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
    /// Mean of q / (q + DIFFERENCE_UNIT) over patches with both means, q: squared difference of
    /// them over the variance that samples of a relative deviation of 1 give it. Negative: none
    /// has.
    double bounded_difference = -1.0;
    bool loose = false;  ///< has no level of its own
};

/// How far the kept mean of a zone's patches is believed.
struct KeptLevel {
    glm::dvec3 scale{1.0};  ///< factor of it
    double limit = 1e30;    ///< samples that it is worth at most
    /// Squared relative deviation of samples of its patches from their means, by what both means
    /// differ in most places.
    double sample_variance = 0.16;
    /// Next to nothing of the zone's light is left: its iterate starts from the dark, since the
    /// distribution of the light that went would last longer than a new solve takes.
    bool anew = false;
};

/// Squared relative deviation of samples whose normally distributed differences have this mean of
/// q / (q + unit), see ZoneMeans::bounded_difference.
double variance_of_samples(double bounded_difference, double unit);

/// Judges what has been kept over a change. Both means estimate the same light, so what their
/// difference, summed over a zone, is beyond its noise is an error of the kept one: it keeps no
/// more weight than such an error leaves. Directly after a change, what enters the zone
/// (ZoneLevels) tells the same at once, and the level of the kept mean follows it.
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
