// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace raybundle {

/// Milliseconds since 1970, for people.
inline double unix_ms() {
    using std::chrono::system_clock;
    return std::chrono::duration<double, std::milli>(system_clock::now().time_since_epoch())
        .count();
}

}  // namespace raybundle
