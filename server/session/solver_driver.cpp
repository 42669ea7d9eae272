// SPDX-License-Identifier: Apache-2.0
#include "session/solver_driver.h"

#include <algorithm>

#include "gpu/egl_context.h"

namespace raybundle {

bool SolverDriver::step() {
    Solver& solver = parts_.scene.solver();
    if (!solver.correcting() && parts_.demand.nobody_waits() && !parts_.snapshots.waiting()) {
        return false;
    }
    if (!parts_.policy.solver_may_run(parts_.viewers.loads(), solver.correcting())) {
        return false;  // the encoder and the viewers can use the time
    }
    fail_as_a_test_wants();
    choose_receivers();
    if (parts_.snapshots.apart() && parts_.demand.nobody_waits() && !solver.correcting() &&
        solver.between_groups()) {
        return true;  // all the time goes into the picture of an earlier scene
    }
    const TimePoint begun = parts_.policy.clock().now();
    solver.step(parts_.receivers.list());
    note_step(parts_.policy.clock().ms_since(begun));
    parts_.server.set_ready(true);
    parts_.errors.refresh_statistics();
    return true;
}

void SolverDriver::note_step(double cost_ms) {
    const std::optional<Strategy> strategy = parts_.scene.solver().last_strategy();
    if (!strategy) {
        parts_.changes.note_bundle(cost_ms);
    }
    parts_.policy.note_step(cost_ms, parts_.viewers.loads());
    parts_.metrics.note_step(strategy, cost_ms);
    if (strategy) {
        parts_.policy.note_iteration(cost_ms, parts_.receivers.pixels());
        parts_.snapshots.note_iteration(cost_ms);
    }
}

/// Chooses the pictures that gather light in the next group of iterations. They stay the same
/// within a group and within a special phase.
void SolverDriver::choose_receivers() {
    const Solver& solver = parts_.scene.solver();
    if (solver.correcting() || !solver.between_groups()) {
        return;
    }
    const std::vector<ViewerLoad> loads = parts_.viewers.loads();
    parts_.receivers.clear();
    for (const ViewerId viewer : parts_.policy.choose_receivers(loads)) {
        parts_.receivers.add(parts_.viewers.at(viewer).image());
    }
    const bool watched =
        std::any_of(loads.begin(), loads.end(), [](const ViewerLoad& l) { return !l.paused; });
    // Who watches a picture at rest waits for it as whoever has asked for a snapshot does.
    const bool undisturbed =
        !watched || parts_.policy.moving_frames_ms(loads) == 0.0 || parts_.demand.nobody_waits();
    parts_.snapshots.hold(parts_.scene.fades().running());
    ViewerImage* const snapshot = parts_.snapshots.next_receiver(
        solver.scene(), solver.store(), parts_.scene.programs(), parts_.scene.epoch(), undisturbed);
    if (snapshot != nullptr) {
        parts_.receivers.add(*snapshot);
    }
}

void SolverDriver::fail_as_a_test_wants() const {
    if (parts_.lost_after_change != 0 && parts_.scene.changed() &&
        parts_.scene.iterations_since_change() >= parts_.lost_after_change) {
        throw GpuError("lost as a test wants it");
    }
}

}  // namespace raybundle
