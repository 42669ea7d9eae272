// SPDX-License-Identifier: Apache-2.0
#include "session/review/review_service.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <string>
#include <utility>

#include "gpu/egl_context.h"
#include "session/measure/probed_pixel.h"
#include "session/messages/scene_messages.h"
#include "session/review/pin_place.h"
#include "session/unix_time.h"
#include "view/point_probe.h"

namespace raybundle {

namespace {

constexpr double pin_check_settled = 0.9;  // before, a pin's light is still on its way
constexpr float good_pin_error = 0.05F;    // relative; below, a pin is not measured again
constexpr double better_pin_error = 0.7;   // of the error before, so that viewers are told
constexpr double pin_look_factor = 1.5;    // of the iterations, between two looks at a pin

}  // namespace

ReviewService::ReviewService(const Parts& parts) : parts_(parts), board_(parts.scene.log()) {}

/// Tells everybody, and answers the request.
void ReviewService::announce(const ClientEvent& event, const v1::ServerMessage& message) {
    parts_.server.reply(event, message);
    parts_.server.broadcast(message, event.message.has_id() ? event.viewer : 0);
}

/// The board has refused what was asked for.
void ReviewService::refuse(const ClientEvent& event) {
    parts_.server.reply_error(event, board_.refusal().code(), board_.refusal().message());
}

/// Answers a request for a note that has been carried out before, under its key. False: it has not.
bool ReviewService::answer_kept(const ClientEvent& event) {
    const KeyedNote* const kept = event.message.has_request_key()
                                      ? parts_.scene.log().kept(event.message.request_key())
                                      : nullptr;
    if (kept == nullptr) {
        return false;
    }
    v1::ServerMessage answer = board_.answer_of(*kept);
    if (answer.body_case() == v1::ServerMessage::BODY_NOT_SET) {
        parts_.server.reply_error(event, v1::Error::INVALID_ARGUMENT,
                                  "requestKey: another request had it");
    } else {
        parts_.server.reply(event, answer);
    }
    return true;
}

/// The side that a new pin lies on: numbers of sides change, and so does what is at a place, while
/// somebody writes. Nothing: no surface is there, which has been answered.
std::optional<std::uint32_t> ReviewService::named_side(const ViewerSession& session,
                                                       const ClientEvent& event) {
    const v1::AddPin& wanted = event.message.add_pin();
    const LiveScene& live = parts_.scene;
    if (wanted.patch() >= live.mesh().side_count()) {
        parts_.server.reply_error(event, v1::Error::NOT_FOUND,
                                  "addPin.patch: no patch " + std::to_string(wanted.patch()));
        return std::nullopt;
    }
    const glm::vec3 point = from_message(wanted.position());
    const auto eye = session.is_caller() ? std::nullopt : std::optional(session.camera().eye);
    const float rounding = probe_rounding(live.solver().scene(), point);
    const auto found = side_near(live.scene(), live.mesh(), wanted.patch(), point, eye, rounding);
    // Positions that people type have few digits; what is further away than that is no surface.
    constexpr float typed = 100.0F;  // times what single precision and the picture round
    if (found && found->distance <= typed * rounding) {
        return found->side;
    }
    std::string text = "addPin.position: no surface is there";
    if (found) {
        text += ", the nearest is " + std::to_string(std::lround(1000.0F * found->distance)) +
                " mm away";
    }
    parts_.server.reply_error(event, v1::Error::NOT_FOUND, text);
    return std::nullopt;
}

HandlerResult ReviewService::add_pin(ViewerSession& session, const ClientEvent& event) {
    if (answer_kept(event)) {
        return HandlerResult::answered;
    }
    const v1::AddPin& wanted = event.message.add_pin();
    const std::optional<std::uint32_t> side = named_side(session, event);
    if (!side) {
        return HandlerResult::answered;
    }
    Pin pin;
    put_on(parts_.scene.scene(), parts_.scene.mesh(), *side, from_message(wanted.position()), pin);
    pin.patch_illuminance = parts_.scene.patch_illuminance(pin.patch);
    v1::PinChanged& message = pin.message;
    message.set_by(event.viewer);
    message.set_by_name(session.name());
    message.set_text(wanted.text());
    message.set_illuminance(pin.patch_illuminance);
    message.set_epoch(parts_.scene.epoch());
    message.set_set_at_ms(unix_ms());
    if (!session.is_caller()) {  // who asks over HTTP looks from nowhere
        const Camera& camera = session.camera();
        to_message(camera.eye, message.mutable_camera()->mutable_eye());
        to_message(camera.target, message.mutable_camera()->mutable_target());
        to_message(camera.up, message.mutable_camera()->mutable_up());
        message.mutable_camera()->set_vertical_fov(camera.vertical_fov);
    }
    measure(session, pin);
    announce_pin(event, board_.add_pin(std::move(pin), event.message.request_key()));
    return HandlerResult::answered;
}

/// Measures the light at a new pin: in the viewer's picture, which knows more than the patch, if it
/// shows the pin's place and nothing before it; else from right in front of it.
void ReviewService::measure(ViewerSession& session, Pin& pin) {
    const LiveScene& live = parts_.scene;
    v1::PinChanged& message = pin.message;
    const glm::vec3 position = from_message(message.position());
    std::optional<PixelProbe> hit;
    if (!session.is_caller()) {
        const auto pixel = pixel_of(session.camera(), session.size(), position);
        parts_.pictures.prepare(session);
        hit = pixel ? session.probe(*pixel) : std::nullopt;
    }
    if (!hit || hit->patch != pin.patch) {
        hit = probe_point(live.solver().scene(), live.solver().store(), live.programs(),
                          live.scene(), live.mesh(), pin.patch, position);
    }
    if (!hit) {
        return;
    }
    message.set_illuminance(luminance(hit->irradiance));
    if (hit->relative_error) {
        message.set_relative_error(static_cast<float>(*hit->relative_error));
    }
}

HandlerResult ReviewService::remove_pin(ViewerSession& /*session*/, const ClientEvent& event) {
    const std::uint32_t number = event.message.remove_pin().pin();
    const auto found = board_.pins().find(number);
    v1::ServerMessage answer;
    if (found != board_.pins().end()) {
        *answer.mutable_pin_changed() = found->second.message;
        answer.mutable_pin_changed()->set_removed(true);
    }
    if (board_.remove_pin(number)) {
        announce(event, answer);
    } else {
        refuse(event);
    }
    return HandlerResult::answered;
}

/// Nothing: the board has refused.
void ReviewService::announce_pin(const ClientEvent& event, const Pin* pin) {
    if (pin == nullptr) {
        refuse(event);
        return;
    }
    v1::ServerMessage answer;
    *answer.mutable_pin_changed() = pin->message;
    announce(event, answer);
}

HandlerResult ReviewService::reply_to_pin(ViewerSession& session, const ClientEvent& event) {
    if (answer_kept(event)) {
        return HandlerResult::answered;
    }
    const v1::ReplyToPin& wanted = event.message.reply_to_pin();
    const auto add_reply = [&](v1::PinChanged& pin) {
        if (pin.replies_size() >= ReviewBoard::max_replies) {
            return std::string("the pin has 100 replies");
        }
        v1::PinReply& reply = *pin.add_replies();
        reply.set_by_name(session.name());
        reply.set_text(wanted.text());
        reply.set_at_ms(unix_ms());
        return std::string();
    };
    announce_pin(event, board_.change_pin(wanted.pin(), "replyToPin", add_reply,
                                          event.message.request_key()));
    return HandlerResult::answered;
}

HandlerResult ReviewService::set_pin(ViewerSession& /*session*/, const ClientEvent& event) {
    const v1::SetPin& wanted = event.message.set_pin();
    announce_pin(event, board_.change_pin(wanted.pin(), "setPin", [&](v1::PinChanged& pin) {
        if (wanted.has_resolved()) {
            pin.set_resolved(wanted.resolved());
        }
        if (wanted.has_assigned_to()) {
            pin.set_assigned_to(wanted.assigned_to());
        }
        return std::string();
    }));
    return HandlerResult::answered;
}

HandlerResult ReviewService::save_viewpoint(ViewerSession& /*session*/, const ClientEvent& event) {
    if (answer_kept(event)) {
        return HandlerResult::answered;
    }
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
    const v1::ViewpointChanged* const added =
        board_.add_viewpoint(std::move(viewpoint), event.message.request_key());
    if (added == nullptr) {
        refuse(event);
        return HandlerResult::answered;
    }
    v1::ServerMessage answer;
    *answer.mutable_viewpoint_changed() = *added;
    announce(event, answer);
    return HandlerResult::answered;
}

HandlerResult ReviewService::remove_viewpoint(ViewerSession& /*session*/,
                                              const ClientEvent& event) {
    const std::uint32_t number = event.message.remove_viewpoint().viewpoint();
    if (!board_.remove_viewpoint(number)) {
        refuse(event);
        return HandlerResult::answered;
    }
    v1::ServerMessage answer;
    answer.mutable_viewpoint_changed()->set_viewpoint(number);
    answer.mutable_viewpoint_changed()->set_by(event.viewer);
    answer.mutable_viewpoint_changed()->set_removed(true);
    announce(event, answer);
    return HandlerResult::answered;
}

HandlerResult ReviewService::point_at(ViewerSession& /*session*/, const ClientEvent& event) {
    v1::ServerMessage message;
    message.mutable_pointed()->set_by(event.viewer);
    *message.mutable_pointed()->mutable_position() = event.message.point_at().position();
    parts_.server.broadcast(message, event.viewer);
    parts_.scene.log().publish(message, false);
    return HandlerResult::ok;
}

HandlerResult ReviewService::list_changes(ViewerSession& /*session*/, const ClientEvent& event) {
    v1::ServerMessage answer;
    parts_.scene.log().records().fill(answer.mutable_change_history());
    parts_.server.reply(event, answer);
    return HandlerResult::answered;
}

void ReviewService::follow(const LogEntry& note) {
    const v1::ServerMessage news = board_.follow(note.kind, note.number, note.body);
    if (news.body_case() != v1::ServerMessage::BODY_NOT_SET) {
        parts_.server.broadcast(news);
    }
}

void ReviewService::check_pin() {
    const Solver& solver = parts_.scene.solver();
    // While the solver rests, no more light comes.
    const bool arriving =
        !parts_.demand.nobody_waits() && solver.statistics().settled < pin_check_settled;
    if (solver.correcting() || arriving || parts_.scene.fades().running()) {
        return;
    }
    Pin* const pin = board_.next_pin();
    if (pin == nullptr) {
        return;
    }
    const bool placed = pin->place.has_value();
    const auto side = side_of(parts_.scene.scene(), parts_.scene.mesh(), *pin);
    if (!side) {
        return;
    }
    if (!placed) {
        board_.keep(*pin);
    }
    const bool changed =
        update_change(*pin, parts_.scene.patch_illuminance(*side), parts_.scene.epoch());
    if (changed || refine(*pin)) {
        board_.keep(*pin);
        v1::ServerMessage message;
        *message.mutable_pin_changed() = pin->message;
        parts_.server.broadcast(message);
    }
}

/// The scene is as it was when the pin was set, and its light was measured too early to be known
/// well.
bool ReviewService::worth_refining(const Pin& pin) const {
    const v1::PinChanged& message = pin.message;
    const bool good = message.has_relative_error() && message.relative_error() <= good_pin_error;
    return !good && message.epoch() == parts_.scene.epoch() &&
           parts_.scene.solver().iterations() >= pin.next_look &&
           !parts_.policy.walking(parts_.viewers.loads());
}

/// Measures the light at a pin again, in the picture of one viewer at rest, each time there are
/// half more iterations. True where there is a better value.
bool ReviewService::refine(Pin& pin) {
    if (!worth_refining(pin)) {
        return false;
    }
    v1::PinChanged& message = pin.message;
    const TimePoint now = parts_.policy.clock().now();
    const glm::vec3 position = from_message(message.position());
    ViewerSession* seeing = nullptr;
    std::optional<glm::uvec2> pixel;
    for (const auto& [id, session] : parts_.viewers) {
        const bool at_rest = session->has_image() && !session->paused() && !session->moving(now);
        if (seeing == nullptr && at_rest) {
            pixel = pixel_of(session->camera(), session->size(), position);
            seeing = pixel ? session.get() : nullptr;
        }
    }
    if (seeing == nullptr) {
        return false;
    }
    const auto iterations = static_cast<double>(parts_.scene.solver().iterations());
    pin.next_look = static_cast<std::uint64_t>(pin_look_factor * iterations) + 1;
    try {
        const auto hit = seeing->probe(*pixel);
        const double before = message.has_relative_error() ? message.relative_error() : 1.0;
        if (!hit || hit->patch != pin.patch || !hit->relative_error ||
            *hit->relative_error >= better_pin_error * before) {
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

}  // namespace raybundle
