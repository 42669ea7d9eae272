// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

namespace raybundle {

/// How long scenes take to be opened, by those before. Not thread-safe.
class OpeningTimes {
  public:
    /// A file of so many bytes has been opened in so many seconds.
    void note(const std::string& file, double bytes, double seconds);

    /// Seconds that a file will take: what it took last, else what the last one took for its size.
    /// Nothing before the first.
    [[nodiscard]] std::optional<double> expected(const std::string& file, double bytes) const;

  private:
    std::map<std::string, double> seconds_;
    double seconds_per_byte_ = 0.0;
};

}  // namespace raybundle
