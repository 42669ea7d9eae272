// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/viewers.h"

#include <utility>

namespace raybundle {

ViewerSession& Viewers::add_to(Sessions& sessions, ViewerId viewer, const v1::Hello& hello,
                               const Camera& camera) const {
    auto session = std::make_unique<ViewerSession>(viewer, hello, camera,
                                                   policy_.settings().viewers, policy_.clock());
    return *sessions.insert_or_assign(viewer, std::move(session)).first->second;
}

ViewerSession& Viewers::add(ViewerId viewer, const v1::Hello& hello, const Camera& camera) {
    return add_to(sessions_, viewer, hello, camera);
}

ViewerSession& Viewers::add_caller(ViewerId viewer, const v1::Hello& hello, const Camera& camera) {
    ViewerSession& session = add_to(callers_, viewer, hello, camera);
    session.set_caller();
    return session;
}

void Viewers::erase(ViewerId viewer) {
    sessions_.erase(viewer);
    callers_.erase(viewer);
}

ViewerSession* Viewers::find(ViewerId viewer) const {
    for (const Sessions* sessions : {&sessions_, &callers_}) {
        if (const auto found = sessions->find(viewer); found != sessions->end()) {
            return found->second.get();
        }
    }
    return nullptr;
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
