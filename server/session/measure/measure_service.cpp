// SPDX-License-Identifier: Apache-2.0
#include "session/measure/measure_service.h"

#include <chrono>
#include <string>
#include <utility>

namespace raybundle {
namespace {

/// After so long a measurement that is not kept is answered as it is.
constexpr std::chrono::seconds longest_wait(30);

}  // namespace

MeasureService::MeasureService(const Parts& parts)
    : parts_(parts), measurer_(parts.policy.settings().rests) {}

HandlerResult MeasureService::measure(ViewerSession& session, const ClientEvent& event) {
    const v1::Measure& measure = event.message.measure();
    MeasureRequest request = from_message(measure);
    if (request.task.points.empty()) {
        parts_.server.reply_error(event, v1::Error::INVALID_ARGUMENT,
                                  "measure.grid: has " + std::to_string(request.grid.columns) +
                                      " x " + std::to_string(request.grid.rows) +
                                      " points, 4096 are the most");
        return HandlerResult::answered;
    }
    if (measurements_.size() >= most_measurements) {
        parts_.server.reply_error(event, v1::Error::RESOURCE_EXHAUSTED,
                                  "measure: there are 16 measurements already");
        return HandlerResult::answered;
    }
    const std::uint32_t number = ++last_number_;
    request.task.settings.seed = number;
    measurer_.add(number, request.task);
    measurements_[number] = {session.id(),   std::move(request),          event,
                             measure.keep(), parts_.policy.clock().now(), {}};
    return HandlerResult::answered;
}

HandlerResult MeasureService::remove(ViewerSession& session, const ClientEvent& event) {
    const std::uint32_t number = event.message.remove_measurement().measurement();
    const auto found = measurements_.find(number);
    if (found == measurements_.end() || found->second.viewer != session.id()) {
        parts_.server.reply_error(
            event, v1::Error::NOT_FOUND,
            "removeMeasurement.measurement: this viewer has no " + std::to_string(number));
        return HandlerResult::answered;
    }
    measurer_.remove(number);
    measurements_.erase(found);
    return HandlerResult::ok;
}

void MeasureService::forget(ViewerId viewer) {
    std::erase_if(measurements_, [&](const auto& entry) {
        if (entry.second.viewer == viewer) {
            measurer_.remove(entry.first);
        }
        return entry.second.viewer == viewer;
    });
}

void MeasureService::step() {
    if (measurements_.empty()) {
        return;
    }
    const LiveScene& live = parts_.scene;
    if (!measurer_.has_scene(live.epoch()) && measurer_.takes_scene()) {
        measurer_.set_scene(live.epoch(), live.scene(), live.mesh());
    }
    for (PointMeasurer::Result& result : measurer_.take()) {
        const auto found = measurements_.find(result.measurement);
        if (found != measurements_.end() && result.epoch == live.epoch()) {
            found->second.last = std::move(result);
        }
    }
    send_waiting();
}

/// One that is not kept goes once its error is met, or after a while.
void MeasureService::send_waiting() {
    const TimePoint now = parts_.policy.clock().now();
    for (auto entry = measurements_.begin(); entry != measurements_.end();) {
        Measurement& measurement = entry->second;
        const bool late = now - measurement.begun >= longest_wait;
        const bool due = measurement.last && (measurement.keep || measurement.last->met || late);
        const bool over = due && !measurement.keep;
        if (due) {
            v1::ServerMessage message;
            to_message(measurement.request, *measurement.last, message.mutable_measured());
            if (measurement.unanswered) {
                parts_.server.reply(*measurement.unanswered, message);
                measurement.unanswered.reset();
            } else {
                parts_.server.send(measurement.viewer, message);
            }
            measurement.last.reset();
        }
        if (over) {
            measurer_.remove(entry->first);
        }
        entry = over ? measurements_.erase(entry) : std::next(entry);
    }
}

}  // namespace raybundle
