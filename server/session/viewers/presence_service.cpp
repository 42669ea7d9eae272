// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/presence_service.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "session/messages/scene_messages.h"

namespace raybundle {

namespace {

v1::Viewer describe_viewer(const ViewerSession& session) {
    const Camera& camera = session.camera();
    const glm::vec2 size(session.size());
    v1::Viewer viewer;
    viewer.set_viewer(session.id());
    viewer.set_name(session.name());
    viewer.set_role(session.role());
    to_message(camera.eye, viewer.mutable_eye());
    to_message(camera.target, viewer.mutable_target());
    to_message(camera.up, viewer.mutable_up());
    viewer.set_vertical_fov(camera.vertical_fov);
    viewer.set_aspect(size.x / size.y);
    viewer.set_following(session.following());
    return viewer;
}

}  // namespace

HandlerResult PresenceService::follow(ViewerSession& session, const ClientEvent& event) {
    const ViewerId leader = event.message.follow().viewer();
    if (leader == session.id()) {
        parts_.server.reply_error(event, v1::Error::INVALID_ARGUMENT,
                                  "follow.viewer: that is this viewer itself");
        return HandlerResult::answered;
    }
    const ViewerSession* const found = parts_.viewers.find(leader);
    if (leader != 0 && found == nullptr) {
        parts_.server.reply_error(event, v1::Error::NOT_FOUND,
                                  "follow.viewer: no viewer " + std::to_string(leader));
        return HandlerResult::answered;
    }
    session.follow(leader);
    if (leader != 0) {
        session.adopt_camera(found->camera());
        lead(session);
    }
    changed_ = true;
    return HandlerResult::ok;
}

void PresenceService::lead(const ViewerSession& leader) {
    changed_ = true;
    std::set<ViewerId> seen{leader.id()};
    std::vector<ViewerId> leaders{leader.id()};
    while (!leaders.empty()) {
        const ViewerId current = leaders.back();
        leaders.pop_back();
        for (const auto& [id, session] : parts_.viewers) {
            if (session->following() == current && seen.insert(id).second) {
                session->adopt_camera(leader.camera());
                leaders.push_back(id);
            }
        }
    }
}

void PresenceService::forget(ViewerId viewer) {
    changed_ = true;
    for (const auto& [id, session] : parts_.viewers) {
        if (session->following() == viewer) {
            session->follow(0);
        }
    }
}

void PresenceService::send() {
    const MessagePaceSettings& pace = parts_.policy.settings().messages;
    const TimePoint now = parts_.policy.clock().now();
    const double interval_s =
        std::max(pace.min_presence_s,
                 pace.presence_per_viewer_s * static_cast<double>(parts_.viewers.size()));
    if (!changed_ || seconds(now - last_sent_) < interval_s) {
        return;
    }
    changed_ = false;
    last_sent_ = now;
    v1::ServerMessage message;
    message.mutable_presence()->set_crowded(parts_.policy.crowded(parts_.viewers.loads()));
    for (const auto& [id, session] : parts_.viewers) {
        *message.mutable_presence()->add_viewers() = describe_viewer(*session);
    }
    parts_.server.broadcast(message);
}

}  // namespace raybundle
