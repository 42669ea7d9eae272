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

Camera camera_of(const v1::Viewer& viewer) {
    Camera camera;
    camera.eye = from_message(viewer.eye());
    camera.target = from_message(viewer.target());
    camera.up = from_message(viewer.up());
    camera.vertical_fov = viewer.vertical_fov();
    return camera;
}

constexpr double heartbeat_s = 1.0;  // of what other servers are told, see PeerViewers::silence_s

}  // namespace

HandlerResult PresenceService::follow(ViewerSession& session, const ClientEvent& event) {
    const ViewerId leader = event.message.follow().viewer();
    if (leader == session.id()) {
        parts_.server.reply_error(event, v1::Error::INVALID_ARGUMENT,
                                  "follow.viewer: that is this viewer itself");
        return HandlerResult::answered;
    }
    const ViewerSession* const found = parts_.viewers.find(leader);
    const v1::Viewer* const peer = peers_.find(leader);
    if (leader != 0 && found == nullptr && peer == nullptr) {
        parts_.server.reply_error(event, v1::Error::NOT_FOUND,
                                  "follow.viewer: no viewer " + std::to_string(leader));
        return HandlerResult::answered;
    }
    session.follow(leader);
    if (leader != 0) {
        session.adopt_camera(found != nullptr ? found->camera() : camera_of(*peer));
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

void PresenceService::hear_peers() {
    if (!parts_.log.shared()) {
        return;
    }
    const TimePoint now = parts_.policy.clock().now();
    bool changed = peers_.forget_silent(now);
    for (const PeerNews& news : parts_.log.take_news()) {
        v1::ServerMessage message;
        if (!message.ParseFromString(news.body)) {
            continue;
        }
        if (message.has_presence()) {
            changed |= peers_.note(news.server, message.presence(), now);
        } else if (message.has_pointed()) {
            message.mutable_pointed()->set_by(
                peers_.number_here(news.server, message.pointed().by(), now));
            parts_.server.broadcast(message);
        }
    }
    if (changed) {
        changed_ = true;
        follow_peers();
    }
    v1::Presence own;
    if (seconds(now - told_) >= heartbeat_s) {
        for (const auto& [id, session] : parts_.viewers) {
            *own.add_viewers() = describe_viewer(*session);
        }
        tell_peers(own, now);
    }
}

/// Who follows somebody on another server sees what that one sees, until it is gone.
void PresenceService::follow_peers() {
    for (const auto& [id, session] : parts_.viewers) {
        const ViewerId leader = session->following();
        if (leader == 0 || parts_.viewers.find(leader) != nullptr) {
            continue;
        }
        const v1::Viewer* const peer = peers_.find(leader);
        if (peer == nullptr) {
            session->follow(0);
        } else {
            session->adopt_camera(camera_of(*peer));
            lead(*session);
        }
    }
}

void PresenceService::tell_peers(const v1::Presence& own, TimePoint now) {
    told_ = now;
    v1::ServerMessage message;
    *message.mutable_presence() = own;
    parts_.log.publish(message, true);
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
    tell_peers(message.presence(), now);
    peers_.describe(message.mutable_presence());
    parts_.server.broadcast(message);
}

}  // namespace raybundle
