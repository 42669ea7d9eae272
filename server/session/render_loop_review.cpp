// SPDX-License-Identifier: Apache-2.0
// What the render loop does for people who look together: who is here, who follows whom, pins,
// viewpoints.
#include <algorithm>
#include <set>

#include "session/render_loop.h"
#include "session/scene_messages.h"
#include "session/unix_time.h"
#include "session/viewers/probed_pixel.h"
#include "view/point_probe.h"

namespace raybundle {

namespace {

constexpr double min_presence_interval_s = 0.1;
constexpr double presence_interval_per_viewer_s = 0.01;
constexpr double pin_check_settled = 0.9;  // before, a pin's light is still on its way

}  // namespace

/// False: not a message of this file.
bool RenderLoop::handle_review(ViewerSession& session, const ClientEvent& event) {
    const v1::ClientMessage& message = event.message;
    switch (message.body_case()) {
        case v1::ClientMessage::kFollow:
            follow(session, event);
            return true;
        case v1::ClientMessage::kAddPin:
            add_pin(session, event);
            return true;
        case v1::ClientMessage::kRemovePin:
            remove_pin(event);
            return true;
        case v1::ClientMessage::kSaveViewpoint:
            save_viewpoint(event);
            return true;
        case v1::ClientMessage::kRemoveViewpoint:
            remove_viewpoint(event);
            return true;
        case v1::ClientMessage::kPointAt:
            point_at(event);
            return true;
        case v1::ClientMessage::kProbeGrid:
            probe_grid(session, event);
            return true;
        case v1::ClientMessage::kListChanges: {
            v1::ServerMessage answer;
            log_.records().fill(answer.mutable_change_history());
            server_.reply(event, answer);
            return true;
        }
        default:
            return false;
    }
}

void RenderLoop::announce(const ClientEvent& event, const v1::ServerMessage& message) {
    server_.reply(event, message);
    server_.broadcast(message, event.message.has_id() ? event.viewer : 0);
}

void RenderLoop::follow(ViewerSession& session, const ClientEvent& event) {
    const ViewerId leader = event.message.follow().viewer();
    if (leader == session.id()) {
        server_.reply_error(event, v1::Error::INVALID_ARGUMENT,
                            "follow.viewer: that is this viewer itself");
        return;
    }
    const auto found = sessions_.find(leader);
    if (leader != 0 && found == sessions_.end()) {
        server_.reply_error(event, v1::Error::NOT_FOUND,
                            "follow.viewer: no viewer " + std::to_string(leader));
        return;
    }
    session.follow(leader);
    if (leader != 0) {
        session.adopt_camera(found->second->camera());
        lead(session);
    }
    presence_changed_ = true;
    server_.reply_ok(event);
}

/// The followers of a viewer, and theirs, see what it sees.
void RenderLoop::lead(const ViewerSession& leader) {
    presence_changed_ = true;
    std::set<ViewerId> seen{leader.id()};
    std::vector<ViewerId> leaders{leader.id()};
    while (!leaders.empty()) {
        const ViewerId current = leaders.back();
        leaders.pop_back();
        for (const auto& [id, session] : sessions_) {
            if (session->following() == current && seen.insert(id).second) {
                session->adopt_camera(leader.camera());
                leaders.push_back(id);
            }
        }
    }
}

/// A viewer has left: nobody follows it any more.
void RenderLoop::forget_leader(ViewerId viewer) {
    presence_changed_ = true;
    for (const auto& [id, session] : sessions_) {
        if (session->following() == viewer) {
            session->follow(0);
        }
    }
}

void RenderLoop::add_pin(ViewerSession& session, const ClientEvent& event) {
    const v1::AddPin& wanted = event.message.add_pin();
    const glm::vec3 position = from_message(wanted.position());
    if (wanted.patch() >= mesh_.side_count()) {
        server_.reply_error(event, v1::Error::NOT_FOUND,
                            "addPin.patch: no patch " + std::to_string(wanted.patch()));
        return;
    }
    Pin pin;
    pin.patch = wanted.patch();
    pin.patch_illuminance = luminance(solver_->store().read_irradiance(mesh_.patch_of(pin.patch)));
    v1::PinChanged& message = pin.message;
    message.set_by(event.viewer);
    message.set_by_name(session.name());
    message.set_text(wanted.text());
    *message.mutable_position() = wanted.position();
    message.set_illuminance(pin.patch_illuminance);
    message.set_epoch(epoch_);
    message.set_set_at_ms(unix_ms());
    *message.mutable_local_position() = wanted.position();
    const auto pixel = pixel_of(session.camera(), session.size(), position);
    prepare_image(session);
    // A pixel tells more than the patch, where it shows the pin's place and nothing before it.
    auto hit = pixel ? session.probe(*pixel) : std::nullopt;
    if (!hit || hit->patch != pin.patch) {
        hit = probe_point(solver_->scene(), solver_->store(), *programs_, scene_, mesh_, pin.patch,
                          position);
    }
    if (hit) {
        const Object& object = scene_.objects[hit->object];
        const glm::mat4 object_from_world = glm::inverse(object.world_from_object());
        message.set_object(object.id);
        to_message(glm::vec3(object_from_world * glm::vec4(position, 1.0F)),
                   message.mutable_local_position());
        message.set_illuminance(luminance(hit->irradiance));
        if (hit->relative_error) {
            message.set_relative_error(static_cast<float>(*hit->relative_error));
        }
    }
    const Pin* added = review_.add_pin(std::move(pin));
    if (added == nullptr) {
        server_.reply_error(event, review_.refusal().code(), review_.refusal().message());
        return;
    }
    v1::ServerMessage answer;
    *answer.mutable_pin_changed() = added->message;
    announce(event, answer);
}

void RenderLoop::remove_pin(const ClientEvent& event) {
    const std::uint32_t number = event.message.remove_pin().pin();
    const auto found = review_.pins().find(number);
    v1::ServerMessage answer;
    if (found != review_.pins().end()) {
        *answer.mutable_pin_changed() = found->second.message;
        answer.mutable_pin_changed()->set_removed(true);
    }
    if (review_.remove_pin(number)) {
        announce(event, answer);
    } else {
        server_.reply_error(event, review_.refusal().code(), review_.refusal().message());
    }
}

void RenderLoop::save_viewpoint(const ClientEvent& event) {
    const v1::SaveViewpoint& wanted = event.message.save_viewpoint();
    v1::ViewpointChanged viewpoint;
    viewpoint.set_by(event.viewer);
    v1::Camera& camera = *viewpoint.mutable_camera();
    camera.set_name(wanted.name());
    *camera.mutable_eye() = wanted.eye();
    *camera.mutable_target() = wanted.target();
    camera.mutable_up()->set_y(1.0F);
    if (wanted.has_up()) {
        *camera.mutable_up() = wanted.up();
    }
    camera.set_vertical_fov(wanted.vertical_fov());
    const v1::ViewpointChanged* added = review_.add_viewpoint(std::move(viewpoint));
    if (added == nullptr) {
        server_.reply_error(event, review_.refusal().code(), review_.refusal().message());
        return;
    }
    v1::ServerMessage answer;
    *answer.mutable_viewpoint_changed() = *added;
    announce(event, answer);
}

void RenderLoop::remove_viewpoint(const ClientEvent& event) {
    const std::uint32_t number = event.message.remove_viewpoint().viewpoint();
    if (!review_.remove_viewpoint(number)) {
        server_.reply_error(event, review_.refusal().code(), review_.refusal().message());
        return;
    }
    v1::ServerMessage answer;
    answer.mutable_viewpoint_changed()->set_viewpoint(number);
    answer.mutable_viewpoint_changed()->set_by(event.viewer);
    answer.mutable_viewpoint_changed()->set_removed(true);
    announce(event, answer);
}

void RenderLoop::point_at(const ClientEvent& event) {
    v1::ServerMessage message;
    message.mutable_pointed()->set_by(event.viewer);
    *message.mutable_pointed()->mutable_position() = event.message.point_at().position();
    server_.broadcast(message, event.viewer);
    server_.reply_ok(event);
}

/// Tells everybody who is here, where that has changed and not too often.
void RenderLoop::send_presence(Clock::time_point now) {
    const double interval =
        std::max(min_presence_interval_s,
                 presence_interval_per_viewer_s * static_cast<double>(sessions_.size()));
    const double since = std::chrono::duration<double>(now - last_presence_).count();
    if (!presence_changed_ || since < interval) {
        return;
    }
    presence_changed_ = false;
    last_presence_ = now;
    v1::ServerMessage message;
    message.mutable_presence()->set_crowded(crowded());
    for (const auto& [id, session] : sessions_) {
        v1::Viewer& viewer = *message.mutable_presence()->add_viewers();
        const Camera& camera = session->camera();
        const glm::vec2 size(session->size());
        viewer.set_viewer(id);
        viewer.set_name(session->name());
        viewer.set_role(session->role());
        to_message(camera.eye, viewer.mutable_eye());
        to_message(camera.target, viewer.mutable_target());
        to_message(camera.up, viewer.mutable_up());
        viewer.set_vertical_fov(camera.vertical_fov);
        viewer.set_aspect(size.x / size.y);
        viewer.set_following(session->following());
    }
    server_.broadcast(message);
}

/// Measures the light at a pin again while the scene is as it was when it was set, where that was
/// too early for a good value. One viewer at rest is asked at a time, each time there are half more
/// iterations. True where there is a better value.
bool RenderLoop::refine_pin(Pin& pin) {
    constexpr float good = 0.05F;       // relative error
    constexpr double better = 0.7;      // of the one before
    constexpr double more_often = 1.5;  // of the iterations
    v1::PinChanged& message = pin.message;
    const auto now = Clock::now();
    const std::uint64_t iterations = solver_->iterations();
    if (message.epoch() != epoch_ || iterations < pin.next_look || walking(now) ||
        (message.has_relative_error() && message.relative_error() <= good)) {
        return false;
    }
    const glm::vec3 position = from_message(message.position());
    const auto pixel_in = [&](const ViewerSession& session) {
        const bool at_rest = session.has_image() && !session.paused() && !session.moving(now);
        return at_rest ? pixel_of(session.camera(), session.size(), position) : std::nullopt;
    };
    const auto seeing = std::find_if(sessions_.begin(), sessions_.end(), [&](const auto& entry) {
        return pixel_in(*entry.second).has_value();
    });
    if (seeing == sessions_.end()) {
        return false;
    }
    pin.next_look = static_cast<std::uint64_t>(more_often * static_cast<double>(iterations)) + 1;
    try {
        const auto hit = seeing->second->probe(*pixel_in(*seeing->second));
        const double before = message.has_relative_error() ? message.relative_error() : 1.0;
        if (!hit || hit->patch != pin.patch || !hit->relative_error ||
            *hit->relative_error >= better * before) {
            return false;
        }
        message.set_illuminance(luminance(hit->irradiance));
        message.set_relative_error(static_cast<float>(*hit->relative_error));
        return true;
    } catch (const GpuError& error) {
        spdlog::warn("the light at pin {} is not measured again: {}", message.pin(), error.what());
        return false;
    }
}

/// Looks at the light of one pin, and tells everybody where it has changed.
void RenderLoop::check_pin() {
    // Where the solver rests, no more light comes.
    const bool arriving = !nobody_waits() && solver_->statistics().settled < pin_check_settled;
    if (solver_->correcting() || arriving) {
        return;
    }
    Pin* pin = review_.next_pin();
    if (pin == nullptr) {
        return;
    }
    const bool changed = update_change(
        *pin, luminance(solver_->store().read_irradiance(mesh_.patch_of(pin->patch))), epoch_);
    if (changed || refine_pin(*pin)) {
        review_.keep(*pin);
        v1::ServerMessage message;
        *message.mutable_pin_changed() = pin->message;
        server_.broadcast(message);
    }
}

}  // namespace raybundle
