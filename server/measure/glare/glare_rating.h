// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/interval.h"

namespace raybundle {

/// A source of glare as an eye sees it.
struct GlareShare {
    std::string name;
    std::uint32_t light = 0;   ///< number of the light on the wire; 0: none of them
    glm::dvec3 position{0.0};  ///< of the middle of what is seen, world space, m
    double share = 0.0;        ///< of the sum that glares
    double luminance = 0.0;    ///< mean of what is seen, cd/m²; 0: it has no size
    double solid_angle = 0.0;  ///< sr
    double position_index = 0.0;
};

/// What is told of the glare at a place.
struct GlareRating {
    enum class State {
        rated,
        no_source,  ///< nothing glares
        outside     ///< of the method's range: `words` say why
    };
    static constexpr std::size_t most_sources = 8;

    State state = State::outside;
    Interval value;                  ///< 95 %, where it is rated
    double error = 0.0;              ///< standard error of the worst view's value
    std::size_t views = 1;           ///< of which it is the worst, rated ones
    glm::dvec3 view{0.0};            ///< worst of the directions, unit
    double background = 0.0;         ///< luminance, cd/m²; of DGP the vertical illuminance, lx
    std::uint32_t sources = 0;       ///< that are counted
    std::uint32_t below = 0;         ///< left out: below the line of sight
    std::uint32_t beyond = 0;        ///< left out: H/R above 2, beyond the table of CIE 117
    std::uint32_t small = 0;         ///< less than 0.005 m² of projected luminous area
    std::uint32_t large = 0;         ///< more than 0.1 sr
    std::vector<GlareShare> shares;  ///< the strongest first, at most most_sources
    std::vector<double> ratios;  ///< of DGP: mean luminances, cd/m², within cones about the view
    std::string words;           ///< what is left out or outside of the range; may be empty
};

/// Degrees of freedom of standard errors: those of 16 batches.
constexpr std::size_t glare_degrees = 15;

/// The worst of a place's views: what has no number is worse than what has one. Its interval is
/// that of the largest of all, see interval_of_largest(). There is one view at least.
GlareRating worst_of(std::vector<GlareRating> views);

/// Of a view in air that absorbs or scatters: `method` is not defined there, and gives no number.
GlareRating rating_in_air(const glm::dvec3& view, const std::string& method);

/// Mean, least and worst of what is rated. The mean has the mean ends: places share their
/// luminaires, so that errors may add up. The worst of all views of all places lies below the
/// largest lower bound where any of them fails, so each has 1 - 2.5 %/n, n views in all; the least
/// of p places above the smallest upper bound likewise, with p. Nothing where nothing is rated.
struct GlareRange {
    Interval mean, minimum, maximum;
};
std::optional<GlareRange> range_of(std::span<const GlareRating> ratings);

}  // namespace raybundle
