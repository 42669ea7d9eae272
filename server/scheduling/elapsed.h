// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace raybundle {

using SteadyClock = std::chrono::steady_clock;

inline double seconds(SteadyClock::duration duration) {
    return std::chrono::duration<double>(duration).count();
}

inline double milliseconds(SteadyClock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

inline double milliseconds_since(SteadyClock::time_point start) {
    return milliseconds(SteadyClock::now() - start);
}

}  // namespace raybundle
