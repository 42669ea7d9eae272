// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "commands/render_job.h"

namespace raybundle {

/// Progress of a long command on standard error: a bar with the time left where that is a terminal,
/// otherwise a line in the log for each stage.
class AccuracyProgress {
  public:
    AccuracyProgress();
    ~AccuracyProgress();
    AccuracyProgress(const AccuracyProgress&) = delete;
    AccuracyProgress& operator=(const AccuracyProgress&) = delete;

    void begin(const std::string& stage);
    /// share: of the whole stage, 0 to 1; seconds_left: of all that can be foreseen.
    void show(double share, double seconds_left, const std::string& detail);

  private:
    void clear() const;

    bool terminal_;
    std::string stage_;
    std::optional<Stopwatch> last_;
};

}  // namespace raybundle
