// SPDX-License-Identifier: Apache-2.0
// What the render loop does with requests for pictures that are rendered apart.
#include "session/render_loop.h"

namespace raybundle {

void RenderLoop::add_snapshot(const ViewerSession& session, const ClientEvent& event) {
    const v1::Snapshot& wanted = event.message.snapshot();
    if (wanted.has_epoch() && wanted.epoch() > epoch_) {
        server_.reply_error(
            event, v1::Error::INVALID_ARGUMENT,
            "snapshot.epoch: there have been only " + std::to_string(epoch_) + " changes");
    } else if (wanted.has_epoch() && wanted.epoch() < log_.history().oldest()) {
        server_.reply_error(event, v1::Error::NOT_FOUND,
                            "snapshot.epoch: what was before change " +
                                std::to_string(log_.history().oldest()) + " is not known any more");
    } else {
        snapshots_.add(event, session.camera(), session.look());
    }
}

/// The picture that is being made takes no part in what is under way any more.
void RenderLoop::cancel_snapshot(const ClientEvent& event) {
    if (snapshots_.is_making(event.viewer, event.message.cancel_snapshot().request())) {
        std::erase(receivers_, snapshots_.picture_of(event.viewer));
    }
    snapshots_.cancel(event);
}

/// As it was right after a change; null where that is not known any more.
std::unique_ptr<EarlierScene> RenderLoop::earlier_scene(std::uint32_t epoch) const {
    const auto changes = log_.history().back_to(epoch);
    return changes
               ? std::make_unique<EarlierScene>(epoch, scene_, mesh_, *changes, settings_.solver)
               : nullptr;
}

}  // namespace raybundle
