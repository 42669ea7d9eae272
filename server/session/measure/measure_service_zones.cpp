// SPDX-License-Identifier: Apache-2.0
// Zones and requirements that come from the project's log: of before a restart, or of its other
// servers.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "session/measure/measure_service.h"

namespace raybundle {
namespace {

/// Numbers of measurements that are no zones begin there where other servers number zones, too.
constexpr std::uint32_t first_own_number = 1U << 30U;

}  // namespace

std::optional<std::uint32_t> MeasureService::new_number(bool zone) {
    ChangeLog& log = parts_.scene.log();
    if (!zone && log.shared()) {
        return std::max(last_own_number_, first_own_number) + 1;
    }
    return zone ? log.new_number(NoteKind::zone, last_number_ + 1)
                : std::optional(last_number_ + 1);
}

void MeasureService::note_number(std::uint32_t number) {
    std::uint32_t& last = number > first_own_number ? last_own_number_ : last_number_;
    last = std::max(last, number);
}

/// False: it has no points to measure, or there are too many zones.
bool MeasureService::take_up(v1::JournalZone zone) {
    MeasureRequest request = from_message(zone.measure());
    const bool full = count(true) >= most_zones;
    if (request.task.points.empty() || full) {
        const std::string why = request.problem.empty() ? "it has no points" : request.problem;
        spdlog::warn("zone '{}' of the project is left out: {}", zone.measure().name(),
                     full ? fmt::format("there are {} zones already", most_zones) : why);
        return false;
    }
    const std::uint32_t number = zone.number();
    note_number(number);
    request.task.settings.seed = number;
    measurer_.add(number, request.task);
    Measurement& added = measurements_[number];
    added = {0, std::move(request), std::nullopt, true, parts_.policy.clock().now()};
    added.zone = std::move(zone);
    show_again(added);
    return true;
}

void MeasureService::restore_zones() {
    for (const std::string& body : parts_.scene.log().notes(NoteKind::zone)) {
        v1::JournalZone zone;
        if (zone.ParseFromString(body) && !zone.measure().name().empty()) {
            static_cast<void>(take_up(std::move(zone)));
        }
    }
}

void MeasureService::follow(const LogEntry& note) {
    if (note.kind == NoteKind::requirements) {
        board_.restore(note.body);
        tell_requirements();
        return;
    }
    v1::JournalZone zone;
    if (note.body.empty()) {
        if (find_zone(note.number) != nullptr) {
            drop(note.number);
        }
        return;
    }
    if (!zone.ParseFromString(note.body) || zone.measure().name().empty()) {
        return;
    }
    ++version_;
    Measurement* known = find_zone(note.number);
    if (known != nullptr) {  // its name or requirement
        known->zone = std::move(zone);
        show_again(*known);
    } else if (take_up(std::move(zone))) {
        known = find_zone(note.number);
    }
    if (known != nullptr) {
        send(*known);
    }
}

/// Forgets a measurement; everybody hears of it where it is a zone.
void MeasureService::drop(std::uint32_t number) {
    if (const Measurement* const zone = find_zone(number)) {
        ++version_;
        v1::ServerMessage message;
        message.mutable_measured()->set_measurement(number);
        message.mutable_measured()->set_name(zone->zone.measure().name());
        message.mutable_measured()->set_removed(true);
        parts_.server.broadcast(message);
    }
    measurer_.remove(number);
    results_.erase(number);
    measurements_.erase(number);
}

/// To everybody, with the zones that are held to them.
void MeasureService::tell_requirements() {
    ++version_;
    v1::ServerMessage message;
    board_.fill(message.mutable_requirements_changed());
    parts_.server.broadcast(message);
    for (auto& [number, measurement] : measurements_) {
        if (measurement.is_zone() && !measurement.zone.measure().requirement().empty()) {
            show_again(measurement);
            send(measurement);
        }
    }
}

}  // namespace raybundle
