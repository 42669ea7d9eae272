// SPDX-License-Identifier: Apache-2.0
#include "app/opening_times.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace raybundle {
namespace {

/// Size of a file; 0 where it is not known.
double bytes_of(const std::string& file) {
    std::error_code unknown;
    const auto bytes = std::filesystem::file_size(file, unknown);
    return unknown ? 0.0 : static_cast<double>(bytes);
}

}  // namespace

void OpeningTimes::note(const std::string& file, double seconds, double light_seconds) {
    const double bytes = std::max(bytes_of(file), 1.0);
    const std::lock_guard lock(mutex_);
    seconds_[file] = seconds;
    seconds_per_byte_ = std::max(seconds - light_seconds, 0.0) / bytes;
    light_seconds_ = light_seconds;
}

std::optional<double> OpeningTimes::expected(const std::string& file) const {
    const double bytes = bytes_of(file);
    const std::lock_guard lock(mutex_);
    const auto known = seconds_.find(file);
    if (known != seconds_.end()) {
        return known->second;
    }
    return seconds_.empty() ? std::nullopt
                            : std::optional(seconds_per_byte_ * bytes + light_seconds_);
}

}  // namespace raybundle
