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
    /// A file has been shown after so many seconds, of which so many prepared the light: compiled
    /// shaders, which takes as long for small files as for large ones.
    void note(const std::string& file, double seconds, double light_seconds);

    /// Seconds that a file will take: what it took last, else what the last one took to be read for
    /// its size, and for its light. Nothing before the first.
    [[nodiscard]] std::optional<double> expected(const std::string& file) const;

  private:
    mutable std::mutex mutex_;
    std::map<std::string, double> seconds_;
    double seconds_per_byte_ = 0.0;
    double light_seconds_ = 0.0;
};

}  // namespace raybundle
