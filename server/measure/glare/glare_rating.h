// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// Mean, least and worst of what is rated, each interval with the ends of theirs: they share their
/// luminaires, so that errors may add up. Nothing where nothing is rated.
struct GlareRange {
    Interval mean, minimum, maximum;
};
std::optional<GlareRange> range_of(std::span<const GlareRating> ratings);

}  // namespace raybundle
