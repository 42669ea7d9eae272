// SPDX-License-Identifier: Apache-2.0
#include "session/measure/error_service.h"

#include <spdlog/spdlog.h>

#include "gpu/egl_context.h"

namespace raybundle {

ErrorService::ErrorService(const Parts& parts)
    : parts_(parts), checker_(parts.policy.clock(), parts.policy.settings().rests.error_check) {}

void ErrorService::refresh_statistics() {
    const Clock& clock = parts_.policy.clock();
    const TimePoint now = clock.now();
    while (parts_.policy.may_measure_error()) {
        ViewerSession* oldest = nullptr;
        for (const auto& [id, session] : parts_.viewers) {
            if (session->wants_statistics(now) &&
                (oldest == nullptr || session->last_statistics() < oldest->last_statistics())) {
                oldest = session.get();
            }
        }
        if (oldest == nullptr) {
            return;
        }
        const TimePoint begun = clock.now();
        oldest->refresh_statistics(now);
        parts_.policy.note_error_measured(clock.ms_since(begun));
    }
}

void ErrorService::check_pictures() {
    take_result();
    const TimePoint now = parts_.policy.clock().now();
    if (parts_.scene.solver().correcting() || parts_.scene.fades().running() ||
        parts_.policy.walking(parts_.viewers.loads()) || !checker_.idle()) {
        return;
    }
    ViewerSession* longest = nullptr;
    for (const auto& [id, session] : parts_.viewers) {
        if (session->wants_check(now) &&
            (longest == nullptr || session->last_check() < longest->last_check())) {
            longest = session.get();
        }
    }
    if (longest != nullptr) {
        longest->note_check(now);
        check(*longest);
    }
}

void ErrorService::take_result() {
    const auto found = checker_.take();
    ViewerSession* const session = found ? parts_.viewers.find(found->viewer) : nullptr;
    if (session != nullptr && session->last_change() == found->shown_since) {
        session->take_measured(found->square, found->by_samples);
    }
}

void ErrorService::check(ViewerSession& session) {
    const LiveScene& live = parts_.scene;
    if (!checker_.has_scene(live.epoch())) {
        checker_.set_scene(live.epoch(), live.scene(), live.mesh());
    }
    ViewerImage& image = session.image();
    try {
        checker_.check({session.id(), session.last_change(), image.camera(), image.size(),
                        image.read_radiance(), image.statistics()});
    } catch (const GpuError& error) {  // no memory to read it back: the picture itself goes on
        spdlog::warn("viewer {}: its error is not measured: {}", session.id(), error.what());
    }
}

}  // namespace raybundle
