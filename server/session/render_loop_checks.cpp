// SPDX-License-Identifier: Apache-2.0
// What the render loop learns of its viewers' pictures: what their samples say of their errors, and
// what is measured of them.
#include <spdlog/spdlog.h>

#include "gpu/egl_context.h"
#include "scheduling/elapsed.h"
#include "session/render_loop.h"

namespace raybundle {

/// Shows to viewers in turn how good their pictures are, oldest news first.
void RenderLoop::refresh_statistics(Clock::time_point now) {
    while (statistics_.may(Server::now_ms())) {
        ViewerSession* oldest = nullptr;
        for (const auto& [id, session] : sessions_) {
            if (session->wants_statistics(now) &&
                (oldest == nullptr || session->last_statistics() < oldest->last_statistics())) {
                oldest = session.get();
            }
        }
        if (oldest == nullptr) {
            return;
        }
        const auto start = Clock::now();
        oldest->refresh_statistics(now);
        statistics_.charge(milliseconds_since(start));
    }
}

/// Has the true error of a picture at rest measured, of the one that has waited longest. Its
/// reading back stops the GPU for a moment, so not while somebody walks.
void RenderLoop::check_pictures(Clock::time_point now) {
    if (const auto found = checks_.take()) {
        const auto entry = sessions_.find(found->viewer);
        if (entry != sessions_.end() && entry->second->last_change() == found->shown_since) {
            entry->second->take_measured(found->square, found->by_samples);
        }
    }
    if (solver_->correcting() || walking(now) || !checks_.idle(now)) {
        return;
    }
    ViewerSession* longest = nullptr;
    for (const auto& [id, session] : sessions_) {
        if (session->wants_check(now) &&
            (longest == nullptr || session->last_check() < longest->last_check())) {
            longest = session.get();
        }
    }
    if (longest == nullptr) {
        return;
    }
    if (!checks_.has_scene(epoch_)) {
        checks_.set_scene(epoch_, scene_, mesh_);
    }
    longest->note_check(now);
    ViewerImage& image = longest->image();
    try {
        checks_.check({longest->id(), longest->last_change(), image.camera(), image.size(),
                       image.read_radiance(), image.statistics()});
    } catch (const GpuError& error) {  // no memory to read it back: the picture itself goes on
        spdlog::warn("viewer {}: its error is not measured: {}", longest->id(), error.what());
    }
}

}  // namespace raybundle
