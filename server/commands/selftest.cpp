// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "gpu/egl_context.h"
#include "oracle/oracles.h"
#include "oracle/photometry.h"
#include "view/image/whole_file.h"

namespace raybundle {

namespace {

/// Calculation points against closed forms, without a GL context.
int run_photometry_test(const Options& options) {
    constexpr double rounding = 1e-6;  // lights without extent are exact to single precision
    nlohmann::ordered_json report = {{"points", nlohmann::ordered_json::array()}};
    int failed = 0;
    int held = 0;
    double largest = 0.0;
    const std::vector<PhotometryPoint> points = run_photometry();
    for (const PhotometryPoint& point : points) {
        const Interval& found = point.measured;
        failed += point.passed ? 0 : 1;
        held += found.low * (1.0 - rounding) <= point.exact &&
                        point.exact <= found.high * (1.0 + rounding)
                    ? 1
                    : 0;
        largest = std::max(largest, std::abs(point.deviation()));
        fmt::print("{} {:<48} exact {:<9.6g} measured {:<9.6g} ({:.6g} to {:.6g}) {:+.2f} %\n",
                   point.passed ? "ok    " : "FAILED", point.name, point.exact, found.value,
                   found.low, found.high, 100.0 * point.deviation());
        report["points"].push_back({{"name", point.name},
                                    {"passed", point.passed},
                                    {"exact", point.exact},
                                    {"measured", found.value},
                                    {"low", found.low},
                                    {"high", found.high},
                                    {"deviation", point.deviation()}});
    }
    if (!options.output.json_file.empty()) {
        write_file(options.output.json_file, report.dump(2) + "\n");
    }
    fmt::print(
        "photometry: {} points, {} failed; {} of their 95 % intervals hold the exact value; "
        "largest deviation {:.2f} %\n",
        points.size(), failed, held, 100.0 * largest);
    return failed == 0 ? exit_done : exit_failed;
}

}  // namespace

int run_selftest(const Options& options) {
    if (!options.output.json_file.empty()) {
        require_writable(options.output.json_file);
    }
    if (options.selftest.photometry) {
        return run_photometry_test(options);
    }
    const EglContext context = create_egl_context({options.device.gpu, false});
    nlohmann::ordered_json report = {{"device", context.renderer()},
                                     {"tests", nlohmann::ordered_json::array()}};
    int failed = 0;
    for (const Oracle& oracle : all_oracles()) {
        const auto start = std::chrono::steady_clock::now();
        const OracleResult result = oracle.run();
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        failed += result.passed ? 0 : 1;
        fmt::print("{} {:<40} expected {:<10.6g} measured {:<10.6g} bound {:<9.3g} {:.2f} s\n",
                   result.passed ? "ok    " : "FAILED", oracle.name, result.expected,
                   result.measured, result.bound, seconds);
        std::fflush(stdout);
        report["tests"].push_back({{"name", oracle.name},
                                   {"passed", result.passed},
                                   {"expected", result.expected},
                                   {"measured", result.measured},
                                   {"bound", result.bound},
                                   {"seconds", seconds}});
    }
    if (!options.output.json_file.empty()) {
        write_file(options.output.json_file, report.dump(2) + "\n");
    }
    fmt::print("selftest on {}: {} passed, {} failed\n", context.renderer(),
               report["tests"].size() - static_cast<std::size_t>(failed), failed);
    return failed == 0 ? exit_done : exit_failed;
}

}  // namespace raybundle
