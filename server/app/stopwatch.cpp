// SPDX-License-Identifier: Apache-2.0
#include "app/stopwatch.h"

#include <cstdlib>

namespace raybundle {

namespace {

/// 0: the clock is the machine's.
double test_clock_ms() {
    const char* const text =
        std::getenv("RAYBUNDLE_TEST_CLOCK_MS");  // NOLINT(concurrency-mt-unsafe)
    return text == nullptr ? 0.0 : std::strtod(text, nullptr);
}

}  // namespace

double Stopwatch::seconds() const {
    static const double look_ms = test_clock_ms();
    if (look_ms > 0.0) {
        return 1e-3 * look_ms * ++looks_;
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace raybundle
