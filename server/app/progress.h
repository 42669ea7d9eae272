// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/stopwatch.h"

namespace raybundle {

/// Progress of a long command on standard error: a bar with the time left where that is a terminal,
/// otherwise a line in the log for each stage, and one a minute.
class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// stage: in the bar; what the log says of its beginning, nothing where it is empty.
    void begin(const std::string& stage, const std::string& logged);
    void begin(const std::string& stage) { begin(stage, stage); }
    /// Whether show() would draw or log now.
    [[nodiscard]] bool due() const;
    /// share: of the whole stage, 0 to 1; seconds_left: of all that can be foreseen, infinite where
    /// it cannot.
    void show(double share, double seconds_left, const std::string& detail);

  private:
    void clear() const;

    bool terminal_;
    std::string stage_;
    std::optional<Stopwatch> last_;
};

}  // namespace raybundle
