// SPDX-License-Identifier: Apache-2.0
#include "measure/glare/glare_rating.h"

#include <algorithm>

namespace raybundle {

std::optional<GlareRange> range_of(std::span<const GlareRating> ratings) {
    std::optional<GlareRange> range;
    double rated = 0.0;
    for (const GlareRating& rating : ratings) {
        if (rating.state != GlareRating::State::rated) {
            continue;
        }
        const Interval& value = rating.value;
        if (!range) {
            range = GlareRange{{}, value, value};
        }
        const auto take = [&](double Interval::*part) {
            range->mean.*part += value.*part;
            range->minimum.*part = std::min(range->minimum.*part, value.*part);
            range->maximum.*part = std::max(range->maximum.*part, value.*part);
        };
        take(&Interval::value);
        take(&Interval::low);
        take(&Interval::high);
        rated += 1.0;
    }
    if (range) {
        range->mean = {range->mean.value / rated, range->mean.low / rated,
                       range->mean.high / rated};
    }
    return range;
}

}  // namespace raybundle
