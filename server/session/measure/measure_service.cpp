// SPDX-License-Identifier: Apache-2.0
#include "session/measure/measure_service.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

namespace raybundle {
namespace {

/// After so long a measurement that is not kept is answered as it is.
constexpr std::chrono::seconds longest_wait(30);

}  // namespace

MeasureService::MeasureService(const Parts& parts)
    : parts_(parts), board_(parts.scene.log()), measurer_(parts.policy.settings().rests) {
    restore_zones();
}

std::size_t MeasureService::count(bool zones) const {
    return static_cast<std::size_t>(
        std::count_if(measurements_.begin(), measurements_.end(),
                      [zones](const auto& entry) { return entry.second.is_zone() == zones; }));
}

/// Why a request cannot be met; empty: it can.
std::string MeasureService::problem_of(const ViewerSession& session, const v1::Measure& measure,
                                       const MeasureRequest& request, v1::Error::Code& code) const {
    const bool zone = !measure.name().empty();
    if (zone && session.role() < v1::REVIEWER) {
        code = v1::Error::PERMISSION_DENIED;
        return "measure.name: only reviewers and editors keep zones";
    }
    code = v1::Error::INVALID_ARGUMENT;
    if (!request.problem.empty()) {
        return (measure.outline().empty() ? "measure.area: " : "measure.outline: ") +
               (zone ? "zone '" + measure.name() + "' " : std::string()) + request.problem;
    }
    const std::size_t most = most_points(request.task.settings.quantity);
    if (request.task.points.empty() || request.task.points.size() > most) {
        const GridSize& grid =
            request.lattice_size.points() > 0 ? request.lattice_size : request.grid;
        return "measure.grid: has " + std::to_string(grid.columns) + " x " +
               std::to_string(grid.rows) + " points, of which 1 to " + std::to_string(most) +
               " may be measured";
    }
    if (zone && !measure.requirement().empty() && !board_.has(measure.requirement())) {
        code = v1::Error::NOT_FOUND;
        return "measure.requirement: no requirement '" + measure.requirement() + "'";
    }
    code = v1::Error::RESOURCE_EXHAUSTED;
    if (count(zone) >= (zone ? most_zones : most_measurements)) {
        return zone ? "measure: there are 32 zones already"
                    : "measure: there are 16 measurements already";
    }
    return "";
}

/// The log has not stored what was asked for.
void MeasureService::refuse_unsaved(const ClientEvent& event, const std::string& text) const {
    const v1::Error error = parts_.scene.log().refusal(text);
    parts_.server.reply_error(event, error.code(), error.message());
}

bool MeasureService::keep_zone(const v1::JournalZone& zone) {
    ++version_;
    return parts_.scene.log().keep_note(NoteKind::zone, zone.number(), zone.SerializeAsString());
}

HandlerResult MeasureService::measure(ViewerSession& session, const ClientEvent& event) {
    const v1::Measure& measure = event.message.measure();
    MeasureRequest request = from_message(measure);
    v1::Error::Code code{};
    if (const std::string problem = problem_of(session, measure, request, code); !problem.empty()) {
        parts_.server.reply_error(event, code, problem);
        return HandlerResult::answered;
    }
    const bool zone = !measure.name().empty();
    const std::optional<std::uint32_t> free = new_number(zone);
    if (!free) {
        refuse_unsaved(event, "the zone could not be saved");
        return HandlerResult::answered;
    }
    const std::uint32_t number = *free;
    Measurement added{session.id(), std::move(request), event, measure.keep(),
                      parts_.policy.clock().now()};
    if (zone) {
        added.zone.set_number(number);
        *added.zone.mutable_measure() = measure;
        added.zone.set_by_name(session.name());
        if (!keep_zone(added.zone)) {
            refuse_unsaved(event, "the zone could not be saved");
            return HandlerResult::answered;
        }
    }
    note_number(number);
    added.request.task.settings.seed = number;
    measurer_.add(number, added.request.task);
    Measurement& kept = measurements_[number] = std::move(added);
    if (kept.is_zone()) {
        show_again(kept);
    }
    return HandlerResult::answered;
}

MeasureService::Measurement* MeasureService::find_zone(std::uint32_t number) {
    const auto found = measurements_.find(number);
    return found != measurements_.end() && found->second.is_zone() ? &found->second : nullptr;
}

HandlerResult MeasureService::remove(ViewerSession& session, const ClientEvent& event) {
    const std::uint32_t number = event.message.remove_measurement().measurement();
    const auto found = measurements_.find(number);
    const bool zone = found != measurements_.end() && found->second.is_zone();
    if (found == measurements_.end() || (!zone && found->second.viewer != session.id())) {
        parts_.server.reply_error(
            event, v1::Error::NOT_FOUND,
            "removeMeasurement.measurement: this viewer has no " + std::to_string(number));
        return HandlerResult::answered;
    }
    if (zone && session.role() < v1::REVIEWER) {
        parts_.server.reply_error(event, v1::Error::PERMISSION_DENIED,
                                  "removeMeasurement: only reviewers and editors remove zones");
        return HandlerResult::answered;
    }
    if (zone && !parts_.scene.log().keep_note(NoteKind::zone, number, {})) {
        refuse_unsaved(event, "the zone's removal could not be saved");
        return HandlerResult::answered;
    }
    drop(number);
    return HandlerResult::ok;
}

HandlerResult MeasureService::set_zone(ViewerSession& /*session*/, const ClientEvent& event) {
    const v1::SetZone& wanted = event.message.set_zone();
    Measurement* const zone = find_zone(wanted.measurement());
    if (zone == nullptr) {
        parts_.server.reply_error(
            event, v1::Error::NOT_FOUND,
            "setZone.measurement: no zone " + std::to_string(wanted.measurement()));
        return HandlerResult::answered;
    }
    if (!wanted.requirement().empty() && !board_.has(wanted.requirement())) {
        parts_.server.reply_error(
            event, v1::Error::NOT_FOUND,
            "setZone.requirement: no requirement '" + wanted.requirement() + "'");
        return HandlerResult::answered;
    }
    v1::JournalZone changed = zone->zone;
    if (wanted.has_name()) {
        changed.mutable_measure()->set_name(wanted.name());
    }
    if (wanted.has_requirement()) {
        changed.mutable_measure()->set_requirement(wanted.requirement());
    }
    if (!keep_zone(changed)) {
        refuse_unsaved(event, "the zone could not be saved");
        return HandlerResult::answered;
    }
    zone->zone = std::move(changed);
    show_again(*zone);
    send(*zone);
    return HandlerResult::ok;
}

void MeasureService::announce_requirements(const ClientEvent& event, bool done) {
    if (!done) {
        parts_.server.reply_error(event, board_.refusal().code(), board_.refusal().message());
        return;
    }
    tell_requirements();
    parts_.server.reply_ok(event);
}

HandlerResult MeasureService::set_requirement(ViewerSession& /*session*/,
                                              const ClientEvent& event) {
    announce_requirements(event, board_.set(event.message.set_requirement().requirement()));
    return HandlerResult::answered;
}

HandlerResult MeasureService::remove_requirement(ViewerSession& /*session*/,
                                                 const ClientEvent& event) {
    announce_requirements(event, board_.remove(event.message.remove_requirement().name()));
    return HandlerResult::answered;
}

void MeasureService::fill_welcome(v1::Welcome* welcome) const {
    for (const auto& [number, measurement] : measurements_) {
        if (measurement.is_zone()) {
            *welcome->add_zones() = measurement.shown;
        }
    }
    board_.fill(welcome);
}

std::vector<MeasureService::Zone> MeasureService::zones() const {
    std::vector<Zone> result;
    for (const auto& [number, measurement] : measurements_) {
        if (measurement.is_zone()) {
            result.push_back({measurement.request, measurement.zone.measure(), measurement.shown});
        }
    }
    return result;
}

void MeasureService::forget(ViewerId viewer) {
    for (auto& [number, measurement] : measurements_) {
        if (measurement.viewer == viewer && measurement.is_zone()) {
            measurement.viewer = 0;
            measurement.unanswered.reset();
        }
    }
    std::erase_if(measurements_, [&](const auto& entry) {
        const bool own = entry.second.viewer == viewer && !entry.second.is_zone();
        if (own) {
            measurer_.remove(entry.first);
        }
        return own;
    });
}

void MeasureService::step() {
    if (measurements_.empty()) {
        return;
    }
    const LiveScene& live = parts_.scene;
    if (!measurer_.has_scene(live.epoch()) && measurer_.takes_scene()) {
        measurer_.set_scene(live.epoch(), live.scene(), live.settled_mesh());
    }
    for (PointMeasurer::Result& result : measurer_.take()) {
        const auto found = measurements_.find(result.measurement);
        if (found != measurements_.end() && result.epoch == live.epoch()) {
            found->second.last = std::move(result);
        }
    }
    send_waiting();
}

/// What is known of a zone, with what it is to meet.
void MeasureService::show_again(Measurement& measurement) {
    const std::uint32_t number = measurement.zone.number();
    v1::Measured message;
    const auto known = results_.find(number);
    if (known != results_.end()) {
        to_message(measurement.request, known->second, &message);
    } else {
        describe(measurement.request, &message);
        message.set_measurement(number);
    }
    const v1::Measure& measure = measurement.zone.measure();
    message.set_name(measure.name());
    message.set_by_name(measurement.zone.by_name());
    if (board_.has(measure.requirement())) {
        message.set_requirement(measure.requirement());
        const Quantity quantity = measurement.request.task.settings.quantity;
        const bool any = known != results_.end();
        to_message(check(board_.required(measure.requirement(), quantity), quantity,
                         any ? known->second.all : std::nullopt,
                         any ? std::span<const GlareRating>(known->second.glare)
                             : std::span<const GlareRating>(),
                         any ? std::span<const ZoneLuminaire>(known->second.luminaires)
                             : std::span<const ZoneLuminaire>()),
                   &message);
    }
    measurement.shown = std::move(message);
}

/// A zone to everybody, what is kept to who keeps it; an answer to who waits for it.
void MeasureService::send(Measurement& measurement) {
    v1::ServerMessage message;
    *message.mutable_measured() = measurement.shown;
    const ViewerId asking = measurement.unanswered ? measurement.unanswered->viewer : 0;
    if (measurement.unanswered) {
        parts_.server.reply(*measurement.unanswered, message);
        measurement.unanswered.reset();
    } else if (!measurement.is_zone()) {
        parts_.server.send(measurement.viewer, message);
    }
    if (measurement.is_zone()) {
        parts_.server.broadcast(message, asking);
    }
}

/// One that is not kept goes once its error is met, or after a while.
void MeasureService::send_waiting() {
    const TimePoint now = parts_.policy.clock().now();
    for (auto entry = measurements_.begin(); entry != measurements_.end();) {
        Measurement& measurement = entry->second;
        const bool late = now - measurement.begun >= longest_wait;
        const bool due = measurement.last && (measurement.keep || measurement.last->met || late);
        const bool over = due && !measurement.keep;
        if (due && measurement.is_zone()) {
            ++version_;
            results_[entry->first] = std::move(*measurement.last);
            show_again(measurement);
        } else if (due) {
            measurement.shown.Clear();
            to_message(measurement.request, *measurement.last, &measurement.shown);
        }
        if (due) {
            measurement.last.reset();
            send(measurement);
        }
        if (over) {
            measurer_.remove(entry->first);
        }
        entry = over ? measurements_.erase(entry) : std::next(entry);
    }
}

}  // namespace raybundle
