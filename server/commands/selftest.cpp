// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "gpu/egl_context.h"
#include "oracle/oracles.h"
#include "view/image/whole_file.h"

namespace raybundle {

int run_selftest(const Options& options) {
    if (!options.output.json_file.empty()) {
        require_writable(options.output.json_file);
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
