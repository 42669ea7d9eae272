// SPDX-License-Identifier: Apache-2.0
// How large the pictures of viewers are: what the limits and the time leave of what they want.
#include "net/ws/wire_codec.h"
#include "session/memory_room.h"
#include "session/render_loop.h"
#include "session/scene_messages.h"
#include "view/picture_limits.h"

namespace raybundle {

void RenderLoop::fill_limits(v1::Limits* limits) {
    const PictureLimits pictures = picture_limits();
    limits->set_max_width(3840);
    limits->set_max_height(2160);
    limits->set_max_message_bytes(WireLimits().max_message_bytes);
    limits->set_max_viewport_pixels(static_cast<std::uint32_t>(pictures.pixels));
    limits->set_max_viewport_edge(pictures.edge);
    limits->set_max_snapshot_edge(WireLimits().max_picture);
}

/// Whether there is time for a picture of this size. `instead` is the viewer whose picture it would
/// replace, or null.
CostModel::Verdict RenderLoop::admission(glm::uvec2 size, const ViewerSession* instead) const {
    if (settings_.min_frames_per_second <= 0.0) {
        return {};
    }
    double present = 0.0;
    for (const auto& [id, session] : sessions_) {
        present += session->paused() || session.get() == instead ? 0.0 : session->pixels();
    }
    const double limit_ms = 1000.0 / settings_.min_frames_per_second;
    return cost_.admit(size.x, size.y, present, limit_ms);
}

/// Whether several people watch, and a frame for each of them takes more than a second: none sees
/// at once what the others do.
bool RenderLoop::crowded() const {
    constexpr double at_once_ms = 1000.0;  // of attention that stays (R. Miller 1968)
    double pixels = 0.0;
    int watching = 0;
    for (const auto& [id, session] : sessions_) {
        pixels += session->paused() ? 0.0 : session->pixels();
        watching += session->paused() ? 0 : 1;
    }
    return watching > 1 && cost_.round_ms(pixels) > at_once_ms;
}

/// The largest picture of this shape that there is memory for, by what the present ones take;
/// nothing where there is none. A GPU says so itself.
std::optional<glm::uvec2> RenderLoop::within_memory(glm::uvec2 size,
                                                    const ViewerSession* instead) const {
    double bytes = 0.0;
    double pixels = 0.0;
    double released = 0.0;
    for (const auto& [id, session] : sessions_) {
        if (session->has_image()) {
            bytes += static_cast<double>(session->image().bytes());
            pixels += session->pixels();
            released += session.get() == instead ? session->pixels() : 0.0;
        }
    }
    const auto available = settings_.software_rendering ? available_memory() : std::nullopt;
    if (!available || pixels <= 0.0) {
        return size;
    }
    const double per_pixel = bytes / pixels;
    return size_within_memory(size, per_pixel, *available + released * per_pixel);
}

/// The size at which a viewport is served. One beyond the limits, or for which there is no memory,
/// gets the largest of its shape that there is memory and time for: its client has to scale
/// pictures anyway.
glm::uvec2 RenderLoop::served_size(glm::uvec2 wanted, const ViewerSession* instead) const {
    const glm::uvec2 limited = fitted(wanted, picture_limits());
    const glm::uvec2 size = within_memory(limited, instead).value_or(limited);
    const auto fit = size == wanted ? std::nullopt : admission(size, instead).would_fit;
    return fit ? glm::uvec2(fit->first, fit->second) : size;
}

/// Why a picture of this size cannot be served, with what would fit; empty where it can.
std::string RenderLoop::no_room_for(glm::uvec2 size, const ViewerSession* instead) const {
    if (!within_memory(size, instead)) {
        return "the server has no memory for another picture";
    }
    const CostModel::Verdict verdict = admission(size, instead);
    if (verdict.fits) {
        return {};
    }
    const auto& fit = verdict.would_fit;
    return "the server has no time for a picture of " + std::to_string(size.x) + "x" +
           std::to_string(size.y) +
           (fit ? ", " + std::to_string(fit->first) + "x" + std::to_string(fit->second) +
                      " would fit"
                : ", nothing would fit now");
}

void RenderLoop::set_viewport(ViewerSession& session, const ClientEvent& event) {
    const v1::SetViewport& message = event.message.set_viewport();
    const glm::uvec2 wanted(message.width(), message.height());
    const glm::uvec2 size = served_size(wanted, &session);
    const bool larger =
        static_cast<double>(size.x) * static_cast<double>(size.y) > session.pixels();
    if (const std::string reason = larger ? no_room_for(size, &session) : ""; !reason.empty()) {
        server_.reply_error(event, v1::Error::RESOURCE_EXHAUSTED, reason);
        return;
    }
    session.set_viewport(size);
    v1::ServerMessage answer;
    answer.mutable_ok();
    if (size != wanted) {
        to_message(size, answer.mutable_ok()->mutable_viewport());
    }
    server_.reply(event, answer);
}

}  // namespace raybundle
