// SPDX-License-Identifier: Apache-2.0
#include "session/status_reporter.h"

#include <algorithm>

#include "gpu/context_loss.h"

namespace raybundle {

namespace {

constexpr double rate_interval_s = 1.0;

}  // namespace

void StatusReporter::begin() {
    rate_since_ = parts_.policy.clock().now();
}

void StatusReporter::update_metrics() {
    const TimePoint now = parts_.policy.clock().now();
    const double elapsed_s = seconds(now - rate_since_);
    if (elapsed_s < rate_interval_s) {
        return;
    }
    check_context();
    const std::uint64_t iterations = parts_.scene.solver().iterations();
    iterations_per_second_ = static_cast<double>(iterations - rate_iterations_) / elapsed_s;
    rate_iterations_ = iterations;
    rate_since_ = now;
    publish(now);
}

bool StatusReporter::due() {
    const TimePoint now = parts_.policy.clock().now();
    if (seconds(now - last_solution_) < parts_.policy.settings().messages.solution_s) {
        return false;
    }
    last_solution_ = now;
    return true;
}

void StatusReporter::send_solutions() {
    const Solver& solver = parts_.scene.solver();
    for (const auto& [id, session] : parts_.viewers) {
        v1::ServerMessage message;
        v1::Solution* solution = message.mutable_solution();
        solution->set_epoch(parts_.scene.epoch());
        solution->set_iterations(static_cast<std::uint32_t>(solver.iterations()));
        solution->set_iterations_per_second(static_cast<float>(iterations_per_second_));
        solution->set_settled(static_cast<float>(solver.statistics().settled));
        solution->set_saving(parts_.scene.log().saving());
        session->fill_solution(solution);
        parts_.server.send(id, message);
    }
}

void StatusReporter::publish(TimePoint now) {
    const Solver& solver = parts_.scene.solver();
    LoopFigures f;
    f.iterations = solver.iterations();
    f.iterations_per_second = iterations_per_second_;
    f.settled = solver.statistics().settled;
    f.epoch = parts_.scene.epoch();
    f.non_finite = solver.non_finite();
    f.gl_bytes = solver.bytes() + parts_.pictures.bytes();
    for (const auto& [id, session] : parts_.viewers) {
        ++f.viewers;
        f.moving += session->moving(now) ? 1 : 0;
        f.paused += session->paused() ? 1 : 0;
        if (!session->has_image()) {
            continue;
        }
        const ImageStatistics& statistics = session->image().statistics();
        if (statistics.known) {
            f.relative_error = std::max(f.relative_error.value_or(0.0), statistics.relative_error);
        }
    }
    f.journal_failures = parts_.scene.log().failures();
    f.journal_working = parts_.scene.log().working();
    f.exchange = parts_.sharing.figures();
    parts_.metrics.publish(f, now);
}

}  // namespace raybundle
