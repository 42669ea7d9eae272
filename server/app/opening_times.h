// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace raybundle {

/// How long scenes take from being asked for until they are shown, by those before. Thread-safe.
class OpeningTimes {
  public:
    /// A file has been shown after so many seconds.
    void note(const std::string& file, double seconds);

    /// Seconds that a file will take: what it took last, else what the last one took for its size.
    /// Nothing before the first.
    [[nodiscard]] std::optional<double> expected(const std::string& file) const;

  private:
    mutable std::mutex mutex_;
    std::map<std::string, double> seconds_;
    double seconds_per_byte_ = 0.0;
};

}  // namespace raybundle
