// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace raybundle {

using TimePoint = std::chrono::steady_clock::time_point;

inline double seconds(std::chrono::steady_clock::duration duration) {
    return std::chrono::duration<double>(duration).count();
}

inline double milliseconds(std::chrono::steady_clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

/// The one clock of all scheduling. Whoever decides by time gets it from its constructor, so that
/// tests can set it.
class Clock {
  public:
    virtual ~Clock() = default;
    [[nodiscard]] virtual TimePoint now() const = 0;

    /// Since the clock's epoch, which says nothing.
    [[nodiscard]] double now_ms() const { return milliseconds(now().time_since_epoch()); }
    [[nodiscard]] double ms_since(TimePoint start) const { return milliseconds(now() - start); }
};

/// The machine's.
class SteadyClock final : public Clock {
  public:
    [[nodiscard]] TimePoint now() const override { return std::chrono::steady_clock::now(); }
};

/// The one to take where no test sets another.
inline const Clock& steady_clock() {
    static const SteadyClock clock;
    return clock;
}

/// Stands still until it is set. For tests.
class ManualClock final : public Clock {
  public:
    [[nodiscard]] TimePoint now() const override { return now_; }
    void advance_ms(double ms) {
        now_ += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double, std::milli>(ms));
    }

  private:
    TimePoint now_{std::chrono::hours(1)};
};

}  // namespace raybundle
