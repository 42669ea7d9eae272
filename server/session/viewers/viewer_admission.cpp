// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/viewer_admission.h"

#include <algorithm>

#include "net/ws/wire_codec.h"
#include "session/memory_room.h"
#include "session/messages/scene_messages.h"
#include "view/picture_limits.h"

namespace raybundle {

void ViewerAdmission::fill_limits(v1::Limits* limits) {
    const PictureLimits pictures = picture_limits();
    limits->set_max_width(3840);
    limits->set_max_height(2160);
    limits->set_max_message_bytes(WireLimits().max_message_bytes);
    limits->set_max_viewport_pixels(static_cast<std::uint32_t>(pictures.pixels));
    limits->set_max_viewport_edge(pictures.edge);
    limits->set_max_snapshot_edge(WireLimits().max_picture);
}

CostModel::Verdict ViewerAdmission::within_time(glm::uvec2 size,
                                                const ViewerSession* instead) const {
    double present = 0.0;
    for (const auto& [id, session] : parts_.viewers) {
        present += session->paused() || session.get() == instead ? 0.0 : session->pixels();
    }
    return parts_.policy.admit(size.x, size.y, present);
}

/// The largest picture of this shape that there is memory for, by what the present ones take;
/// nothing where there is none. A GPU says so itself.
std::optional<glm::uvec2> ViewerAdmission::within_memory(glm::uvec2 size,
                                                         const ViewerSession* instead) const {
    double bytes = 0.0;
    double pixels = 0.0;
    double released = 0.0;
    for (const auto& [id, session] : parts_.viewers) {
        if (session->has_image()) {
            // Of the picture as it is: a new size counts once it has been drawn.
            const glm::uvec2 present = session->image().full_size();
            const auto own = static_cast<double>(session->image().bytes());
            bytes += own;
            pixels += std::max(static_cast<double>(present.x) * static_cast<double>(present.y),
                               CostModel::min_pixels);
            released += session.get() == instead ? own : 0.0;
        }
    }
    const auto available = parts_.software_rendering ? available_memory() : std::nullopt;
    if (!available || pixels <= 0.0) {
        return size;
    }
    const double per_pixel = bytes / pixels;
    return size_within_memory(size, per_pixel, *available + released);
}

glm::uvec2 ViewerAdmission::served_size(glm::uvec2 wanted, const ViewerSession* instead) const {
    const glm::uvec2 limited = fitted(wanted, picture_limits());
    const glm::uvec2 size = within_memory(limited, instead).value_or(limited);
    const auto fit = size == wanted ? std::nullopt : within_time(size, instead).would_fit;
    return fit ? glm::uvec2(fit->first, fit->second) : size;
}

std::string ViewerAdmission::no_room_for(glm::uvec2 size, const ViewerSession* instead) const {
    if (!within_memory(size, instead)) {
        return "the server has no memory for another picture";
    }
    const CostModel::Verdict verdict = within_time(size, instead);
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

HandlerResult ViewerAdmission::set_viewport(ViewerSession& session, const ClientEvent& event) {
    const v1::SetViewport& message = event.message.set_viewport();
    const glm::uvec2 wanted(message.width(), message.height());
    const glm::uvec2 size = served_size(wanted, &session);
    const bool larger =
        static_cast<double>(size.x) * static_cast<double>(size.y) > session.pixels();
    if (const std::string reason = larger ? no_room_for(size, &session) : ""; !reason.empty()) {
        parts_.server.reply_error(event, v1::Error::RESOURCE_EXHAUSTED, reason);
        return HandlerResult::answered;
    }
    session.set_viewport(size);
    v1::ServerMessage answer;
    answer.mutable_ok();
    if (size != wanted) {
        to_message(size, answer.mutable_ok()->mutable_viewport());
    }
    parts_.server.reply(event, answer);
    return HandlerResult::answered;
}

}  // namespace raybundle
