// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace raybundle {

/// Time since it was made. Where the environment has RAYBUNDLE_TEST_CLOCK_MS, so many milliseconds
/// pass from one look at it to the next, however long that takes: tests of what has a time limit
/// then do the same work on any machine.
class Stopwatch {
  public:
    [[nodiscard]] double seconds() const;

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    mutable unsigned looks_ = 0;
};

}  // namespace raybundle
