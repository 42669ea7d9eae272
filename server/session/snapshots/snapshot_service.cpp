// SPDX-License-Identifier: Apache-2.0
#include "session/snapshots/snapshot_service.h"

#include <string>

namespace raybundle {

HandlerResult SnapshotService::add(ViewerSession& session, const ClientEvent& event) {
    const v1::Snapshot& wanted = event.message.snapshot();
    const std::uint32_t oldest = parts_.scene.log().history().oldest();
    if (wanted.has_epoch() && wanted.epoch() > parts_.scene.epoch()) {
        parts_.server.reply_error(event, v1::Error::INVALID_ARGUMENT,
                                  "snapshot.epoch: there have been only " +
                                      std::to_string(parts_.scene.epoch()) + " changes");
    } else if (wanted.has_epoch() && wanted.epoch() < oldest) {
        parts_.server.reply_error(event, v1::Error::NOT_FOUND,
                                  "snapshot.epoch: what was before change " +
                                      std::to_string(oldest) + " is not known any more");
    } else {
        parts_.queue.add(event, session.camera(), session.look());
    }
    return HandlerResult::answered;
}

/// A picture that is being made takes no part in iterations any more.
HandlerResult SnapshotService::cancel(ViewerSession& session, const ClientEvent& event) {
    if (parts_.queue.is_making(session.id(), event.message.cancel_snapshot().request())) {
        parts_.receivers.remove(parts_.queue.picture_of(session.id()));
    }
    parts_.queue.cancel(event);
    return HandlerResult::answered;
}

void SnapshotService::forget(ViewerId viewer) {
    parts_.receivers.remove(parts_.queue.picture_of(viewer));
    parts_.queue.forget(viewer);
}

std::unique_ptr<EarlierScene> make_earlier_scene(const LiveScene& scene, std::uint32_t epoch) {
    const auto changes = scene.log().history().back_to(epoch);
    return changes ? std::make_unique<EarlierScene>(epoch, scene.scene(), scene.mesh(), *changes,
                                                    scene.solver_settings())
                   : nullptr;
}

}  // namespace raybundle
