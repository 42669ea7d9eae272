// SPDX-License-Identifier: Apache-2.0
#include "net/audit/audit_log.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <nlohmann/json.hpp>

#include "net/clock.h"
#include "net/ws/rules/message_rules.h"

namespace raybundle {
namespace {

using AuditJson = nlohmann::ordered_json;

/// "2026-11-27T15:30:00.123Z".
std::string utc_now() {
    const auto now = std::chrono::system_clock::now();
    const auto since = now.time_since_epoch();
    const auto whole = std::chrono::floor<std::chrono::seconds>(since);
    const auto rest = std::chrono::floor<std::chrono::milliseconds>(since - whole);
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(now)), rest.count());
}

struct Subject {
    const char* name;
    std::uint32_t number;
};

/// What a change is about, with its number.
Subject subject_of_change(const v1::SceneChanged& change) {
    switch (change.change_case()) {
        case v1::SceneChanged::kMoveObject:
            return {"object", change.move_object().object()};
        case v1::SceneChanged::kAddObject:
            return {"object", change.add_object().object()};
        case v1::SceneChanged::kRemoveObject:
            return {"object", change.remove_object().object()};
        case v1::SceneChanged::kSetLight:
            return {"light", change.set_light().light()};
        case v1::SceneChanged::kAddLuminaire:
            return {"light", change.add_luminaire().light()};
        case v1::SceneChanged::kRemoveLight:
            return {"light", change.remove_light().light()};
        case v1::SceneChanged::kSetMaterial:
            return {"material", change.set_material().material()};
        default:
            return {"", 0};
    }
}

std::string name_of_change(const v1::SceneChanged& change) {
    const auto* const field =
        v1::SceneChanged::descriptor()->FindFieldByNumber(static_cast<int>(change.change_case()));
    return field == nullptr ? "change" : field->json_name();
}

}  // namespace

void AuditLog::write(std::string_view event, ViewerId viewer, const AuditIdentity& who,
                     const Fields& fields) {
    AuditJson line{{"time", utc_now()}, {"event", event}};
    if (viewer > 0) {
        line["viewer"] = viewer;
    }
    const auto say = [&line](const char* key, const std::string& text) {
        if (!text.empty()) {
            line[key] = text;
        }
    };
    say("name", who.name);
    say("role", who.role ? v1::Role_Name(*who.role) : "");
    say("token", who.token);
    say("address", who.address);
    for (const auto& [key, value] : fields) {
        std::visit([&line, &key = key](const auto& v) { line[key] = v; }, value);
    }
    file_.append(line.dump(-1, ' ', false, AuditJson::error_handler_t::replace));
}

AuditIdentity AuditLog::identity(ViewerId viewer) const {
    const std::lock_guard lock(mutex_);
    const auto found = identities_.find(viewer);
    return found == identities_.end() ? AuditIdentity{} : found->second;
}

void AuditLog::enter(ViewerId viewer, const AuditIdentity& who) {
    const std::lock_guard lock(mutex_);
    identities_.insert_or_assign(viewer, who);
}

void AuditLog::leave(ViewerId viewer) {
    const std::lock_guard lock(mutex_);
    if (!identities_.contains(viewer)) {
        return;
    }
    left_.push_back(viewer);
    if (left_.size() > max_left) {
        identities_.erase(left_.front());
        left_.pop_front();
    }
}

void AuditLog::connect(ViewerId viewer, const AuditIdentity& who) {
    enter(viewer, who);
    write("connect", viewer, who, {});
}

void AuditLog::disconnect(ViewerId viewer) {
    write("disconnect", viewer, identity(viewer), {});
    leave(viewer);
}

std::optional<std::int64_t> AuditLog::count_refusal() {
    const std::lock_guard lock(mutex_);
    if (!refusals_.take(server_time_ms())) {
        ++unsaid_;
        return std::nullopt;
    }
    return std::exchange(unsaid_, 0);
}

void AuditLog::note_refusal(ViewerId viewer, const AuditIdentity& who, std::string_view what,
                            std::string_view reason) {
    const auto unsaid = count_refusal();
    if (!unsaid) {
        return;
    }
    Fields fields{{"request", std::string(what)}, {"reason", std::string(reason)}};
    if (*unsaid > 0) {
        fields.emplace_back("unsaid", *unsaid);
    }
    write("refuse", viewer, who, fields);
}

void AuditLog::refuse(const AuditIdentity& who, std::string_view what, std::string_view reason) {
    note_refusal(0, who, what, reason);
}

void AuditLog::refuse(ViewerId viewer, std::string_view what, std::string_view reason) {
    note_refusal(viewer, identity(viewer), what, reason);
}

void AuditLog::request(ViewerId viewer, std::string_view what) {
    write("request", viewer, identity(viewer), {{"request", std::string(what)}});
}

void AuditLog::request(const AuditIdentity& who, std::string_view what) {
    write("request", 0, who, {{"request", std::string(what)}});
}

void AuditLog::transfer(const AuditIdentity& who, bool upload, std::string_view path) {
    write(upload ? "upload" : "download", 0, who, {{"path", std::string(path)}});
}

void AuditLog::change(const v1::SceneChanged& change, std::uint32_t epoch) {
    Fields fields{{"change", name_of_change(change)}};
    if (const Subject subject = subject_of_change(change); subject.number > 0) {
        fields.emplace_back(subject.name, std::int64_t{subject.number});
    }
    fields.emplace_back("epoch", std::int64_t{epoch});
    AuditIdentity who = identity(change.by());
    if (who.name.empty()) {
        who.name = change.by_name();
    }
    write("change", change.by(), who, fields);
}

bool is_audited(const v1::ClientMessage& message) {
    using Client = v1::ClientMessage;
    switch (message.body_case()) {
        case Client::kMoveObject:
        case Client::kSetLight:
        case Client::kSetMaterial:
        case Client::kSetDaylight:
        case Client::kAddObject:
        case Client::kRemoveObject:
        case Client::kAddLuminaire:
        case Client::kRemoveLight:
        case Client::kPointAt:  // comes with each move of a hand
            return false;
        case Client::kSnapshot:
            return true;
        default:
            return required_role(message.body_case()) >= v1::REVIEWER;
    }
}

}  // namespace raybundle
