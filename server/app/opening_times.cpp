// SPDX-License-Identifier: Apache-2.0
#include "app/opening_times.h"

#include <algorithm>

namespace raybundle {

void OpeningTimes::note(const std::string& file, double bytes, double seconds) {
    seconds_[file] = seconds;
    seconds_per_byte_ = seconds / std::max(bytes, 1.0);
}

std::optional<double> OpeningTimes::expected(const std::string& file, double bytes) const {
    const auto known = seconds_.find(file);
    if (known != seconds_.end()) {
        return known->second;
    }
    return seconds_per_byte_ > 0.0 ? std::optional(seconds_per_byte_ * bytes) : std::nullopt;
}

}  // namespace raybundle
