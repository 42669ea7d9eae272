// SPDX-License-Identifier: Apache-2.0
#include "net/clock.h"

#include <chrono>

namespace raybundle {
namespace {

const std::chrono::steady_clock::time_point kStart = std::chrono::steady_clock::now();

}  // namespace

double server_time_ms() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - kStart)
        .count();
}

}  // namespace raybundle
