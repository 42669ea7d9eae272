// SPDX-License-Identifier: Apache-2.0
#include "app/solve_job.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "app/render_job.h"

namespace raybundle {

SolveOutcome solve_picture(Solver& solver, FinalPicture& picture, const Options& options) {
    const StopRule rule(options);
    BundleReceiver* const receivers[] = {&picture.receiver()};
    Progress bar;
    bar.begin(options.output.file, {});
    SolveOutcome outcome;
    const Stopwatch stopwatch;
    constexpr std::uint64_t statistics_interval = 16;  // iterations, at least
    constexpr std::uint64_t statistics_share = 16;     // and of them all
    std::uint64_t next_statistics = statistics_interval;
    constexpr std::uint64_t believed_samples = 32;
    constexpr double unknown = 1e9;
    while (true) {
        picture.prepare();
        solver.step(receivers);
        outcome.seconds = stopwatch.seconds();
        if (solver.iterations() >= next_statistics) {
            outcome.statistics = picture.measure();
            next_statistics += std::max(statistics_interval, next_statistics / statistics_share);
        }
        // An error is believed from some samples on; finer than its pixels no picture can be.
        const ImageStatistics& found = outcome.statistics;
        const double estimate =
            found.samples < believed_samples ? unknown : rule.estimate_of(picture);
        const double progress = rule.progress(outcome.seconds, solver.iterations(), estimate);
        if (bar.due()) {
            const double factor = found.known && options.stop.error
                                      ? picture.samples_factor_to(*options.stop.error)
                                      : std::numeric_limits<double>::infinity();
            const double left = rule.seconds_left(outcome.seconds, solver.iterations(), factor);
            show_progress(bar, outcome.seconds, left, solver.iterations(), found.relative_error);
        }
        if (progress >= 1.0) {
            break;
        }
    }
    outcome.statistics = picture.measure();
    if (options.stop.error && outcome.statistics.error_high > *options.stop.error) {
        spdlog::warn("--error {}: not reached; {:.2f} % come from what more time does not mend",
                     *options.stop.error, 100.0 * outcome.statistics.discretisation);
    }
    return outcome;
}

double solve_patches(Solver& solver, const Options& options) {
    const StopRule rule(options);
    Progress bar;
    bar.begin(options.output.file, {});
    const Stopwatch stopwatch;
    while (true) {
        solver.step({});
        const double seconds = stopwatch.seconds();
        constexpr double unknown = 1.0;
        if (bar.due()) {
            const double left = rule.seconds_left(seconds, solver.iterations(),
                                                  std::numeric_limits<double>::infinity());
            show_progress(bar, seconds, left, solver.iterations(), solver.noise());
        }
        if (solver.between_groups() &&
            rule.progress(seconds, solver.iterations(), unknown) >= 1.0) {
            return seconds;
        }
    }
}

}  // namespace raybundle
