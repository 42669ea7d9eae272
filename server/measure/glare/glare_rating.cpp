// SPDX-License-Identifier: Apache-2.0
#include "measure/glare/glare_rating.h"

#include <algorithm>
#include <utility>

namespace raybundle {
namespace {

constexpr double outside_end = 0.025;  // of each end of an interval

int order(const GlareRating& rating) {
    return rating.state == GlareRating::State::outside ? 2
           : rating.state == GlareRating::State::rated ? 1
                                                       : 0;
}

/// So many times the half width that it has for one number, where all of n are to hold.
double widened(std::size_t n) {
    return student_quantile(1.0 - outside_end / static_cast<double>(n), glare_degrees) /
           student_quantile(1.0 - outside_end, glare_degrees);
}

}  // namespace

GlareRating worst_of(std::vector<GlareRating> views) {
    const auto worse = [](const GlareRating& a, const GlareRating& b) {
        return order(a) != order(b) ? order(a) < order(b) : a.value.value < b.value.value;
    };
    GlareRating& worst = *std::max_element(views.begin(), views.end(), worse);
    std::vector<BatchEstimate> estimates;
    for (const GlareRating& view : views) {
        if (view.state == worst.state) {
            estimates.push_back({view.value.value, view.error});
        }
    }
    worst.value = interval_of_largest(estimates, outside_end, glare_degrees);
    worst.views = estimates.size();
    return std::move(worst);
}

GlareRating rating_in_air(const glm::dvec3& view, const std::string& method) {
    GlareRating rating;
    rating.view = view;
    rating.words = "the air absorbs or scatters light: " + method + " is not defined there";
    return rating;
}

std::optional<GlareRange> range_of(std::span<const GlareRating> ratings) {
    std::optional<GlareRange> range;
    std::size_t places = 0;
    std::size_t views = 0;
    for (const GlareRating& rating : ratings) {
        places += rating.state == GlareRating::State::rated ? 1 : 0;
        views += rating.state == GlareRating::State::rated ? rating.views : 0;
    }
    if (places == 0) {
        return range;
    }
    const double all =
        student_quantile(1.0 - outside_end / static_cast<double>(views), glare_degrees);
    const double wider = widened(places);
    const auto share = 1.0 / static_cast<double>(places);
    for (const GlareRating& rating : ratings) {
        if (rating.state != GlareRating::State::rated) {
            continue;
        }
        const Interval& value = rating.value;
        const Interval as_largest{value.value, value.value - all * rating.error, value.high};
        // x + k (max(x_i + e_i) - x) is no less than max(x_i + k e_i) where x is the largest.
        const Interval as_smallest{value.value, value.low,
                                   value.value + wider * (value.high - value.value)};
        if (!range) {
            range = GlareRange{{}, as_smallest, as_largest};
        }
        for (double Interval::*part : {&Interval::value, &Interval::low, &Interval::high}) {
            range->mean.*part += share * value.*part;
            range->minimum.*part = std::min(range->minimum.*part, as_smallest.*part);
            range->maximum.*part = std::max(range->maximum.*part, as_largest.*part);
        }
    }
    return range;
}

}  // namespace raybundle
