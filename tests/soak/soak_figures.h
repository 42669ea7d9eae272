// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon.h"

namespace raybundle {

/// The server over a phase: its memory once settled and in the last quarter, MiB.
struct Footprint {
    double settled = 0.0;
    double last = 0.0;
    double settling_s = 0.0;  ///< after which it counted as settled
    double cores = 0.0;       ///< that the server had, mean
    double error = 0.0;       ///< relative, last known of any picture; NaN: of none

    [[nodiscard]] double growth() const { return last / settled - 1.0; }
};

/// Watches a server for so long.
Footprint watch(Daemon& daemon, double seconds);

/// A figure of /metrics; NaN where it is missing or unknown.
double metric(std::uint16_t port, const std::string& name);

/// NaN of nothing. share: 0..1.
double percentile(std::vector<double> values, double share);

/// Luminances at some places of the Cornell box once a server has done so many iterations more,
/// cd/m2. Throws std::runtime_error where it does not answer.
std::vector<double> light_of(std::uint16_t port, int more_iterations);

/// What a run is expected to show; says of each whether it does.
class Expectations {
  public:
    void expect(bool holds, const std::string& what);
    [[nodiscard]] bool all_hold() const { return all_hold_; }

  private:
    bool all_hold_ = true;
};

}  // namespace raybundle
