// SPDX-License-Identifier: Apache-2.0
// Pins that come back from BIM tools.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gpu/egl_context.h"
#include "report/bcf.h"
#include "session/messages/scene_messages.h"
#include "session/review/pin_place.h"
#include "session/review/review_service.h"
#include "session/unix_time.h"
#include "view/point_probe.h"

namespace raybundle {
namespace {

constexpr const char* text_type = "text/plain; charset=utf-8";

/// Adds the replies that a pin lacks; state and who is to see to it are those of the archive.
void merge(const v1::PinChanged& from, const std::string& guid, v1::PinChanged& pin) {
    pin.set_guid(guid);
    pin.set_resolved(from.resolved());
    pin.set_assigned_to(from.assigned_to());
    for (int i = 0; i < pin.replies_size(); ++i) {
        pin.mutable_replies(i)->set_guid(bcf_reply_guid(guid, pin, i));
    }
    for (const v1::PinReply& reply : from.replies()) {
        const bool known =
            std::any_of(pin.replies().begin(), pin.replies().end(), [&](const v1::PinReply& own) {
                return reply.guid().empty() ? own.text() == reply.text()
                                            : own.guid() == reply.guid();
            });
        if (!known && pin.replies_size() < ReviewBoard::max_replies) {
            *pin.add_replies() = reply;
        }
    }
}

}  // namespace

/// What a new pin lies on: what its viewpoint looks at.
Pin ReviewService::placed(const v1::PinChanged& topic) {
    Pin pin;
    pin.message = topic;
    v1::PinChanged& message = pin.message;
    message.set_epoch(parts_.scene.epoch());
    message.set_set_at_ms(topic.set_at_ms() > 0.0 ? topic.set_at_ms() : unix_ms());
    *message.mutable_local_position() = message.position();
    if (!topic.has_camera()) {
        return pin;
    }
    const LiveScene& live = parts_.scene;
    const glm::vec3 eye = from_message(topic.camera().eye());
    const glm::vec3 ahead = from_message(topic.camera().target()) - eye;
    try {
        const auto hit =
            probe_ray(live.solver().scene(), live.solver().store(), live.programs(), eye, ahead);
        if (hit) {
            put_on(live.scene(), live.mesh(), hit->patch, hit->position, pin);
            pin.patch_illuminance = live.patch_illuminance(hit->patch);
            message.set_illuminance(luminance(hit->irradiance));
        }
    } catch (const GpuError& error) {
        spdlog::warn("a pin of a BCF archive is not on a surface: {}", error.what());
    }
    return pin;
}

DocumentResult ReviewService::import_pins(const std::vector<v1::PinChanged>& topics) {
    const std::string& project = parts_.scene.scene().name;
    std::map<std::string, std::uint32_t> known;
    for (const auto& [number, pin] : board_.pins()) {
        known[bcf_guid(pin.message, project)] = number;
    }
    const auto fresh = static_cast<std::size_t>(
        std::count_if(topics.begin(), topics.end(), [&](const v1::PinChanged& topic) {
            return topic.guid().empty() || !known.contains(topic.guid());
        }));
    if (board_.pins().size() + fresh > ReviewBoard::max_pins) {
        return {507, text_type, "The archive is refused: there would be more than 256 pins\n", {}};
    }
    for (const v1::PinChanged& topic : topics) {
        const auto own = topic.guid().empty() ? known.end() : known.find(topic.guid());
        const Pin* const pin =
            own == known.end()
                ? board_.add_pin(placed(topic))
                : board_.change_pin(own->second, "pins.bcf", [&](v1::PinChanged& message) {
                      merge(topic, topic.guid(), message);
                      return std::string();
                  });
        if (pin == nullptr) {
            return {507, text_type, board_.refusal().message() + "\n", {}};
        }
        v1::ServerMessage message;
        *message.mutable_pin_changed() = pin->message;
        parts_.server.broadcast(message);
    }
    return {200,
            text_type,
            std::to_string(fresh) + " pins added, " + std::to_string(topics.size() - fresh) +
                " brought up to date\n",
            {}};
}

}  // namespace raybundle
