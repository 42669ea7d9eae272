// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/viewers.h"

#include <utility>

namespace raybundle {

ViewerSession& Viewers::add(ViewerId viewer, const v1::Hello& hello, const Camera& camera) {
    auto session = std::make_unique<ViewerSession>(viewer, hello, camera,
                                                   policy_.settings().viewers, policy_.clock());
    return *sessions_.insert_or_assign(viewer, std::move(session)).first->second;
}

ViewerSession* Viewers::find(ViewerId viewer) const {
    const auto found = sessions_.find(viewer);
    return found == sessions_.end() ? nullptr : found->second.get();
}

std::vector<ViewerLoad> Viewers::loads() const {
    const TimePoint now = policy_.clock().now();
    std::vector<ViewerLoad> loads;
    loads.reserve(sessions_.size());
    for (const auto& [id, session] : sessions_) {
        const bool drawn_there = session->draws_itself(now);
        loads.push_back({id, session->has_image() && !drawn_there,
                         session->moving(now) && !drawn_there, session->paused(), session->pixels(),
                         session->drawn_pixels(), session->full_frame_ms()});
    }
    return loads;
}

}  // namespace raybundle
