// SPDX-License-Identifier: Apache-2.0
#include "journal/redis/log_state.h"

#include <algorithm>

namespace raybundle {

void LogState::apply(const StreamEntry& entry) {
    if (entry.id <= last_) {
        return;
    }
    last_ = entry.id;
    if (entry.is_change) {
        add_change(entry.entry.change, sums_[subject_of(entry.entry.change)]);
    } else if (entry.entry.body.empty()) {
        notes_.erase({entry.entry.kind, entry.entry.number});
    } else {
        notes_[{entry.entry.kind, entry.entry.number}] = entry.entry.body;
    }
}

std::vector<v1::SceneChanged> LogState::changes() const {
    std::vector<v1::SceneChanged> result;
    for (const auto& [subject, sum] : sums_) {
        result.push_back(sum);
    }
    std::sort(result.begin(), result.end(),
              [](const auto& a, const auto& b) { return a.epoch() < b.epoch(); });
    return result;
}

std::vector<std::string> LogState::notes(NoteKind kind) const {
    std::vector<std::string> result;
    for (const auto& [key, body] : notes_) {
        if (key.first == kind) {
            result.push_back(body);
        }
    }
    return result;
}

std::string LogState::to_snapshot() const {
    v1::JournalSnapshot snapshot;
    snapshot.set_last(last_.text());
    for (const v1::SceneChanged& change : changes()) {
        *snapshot.add_changes() = change;
    }
    for (const auto& [key, body] : notes_) {
        v1::JournalSnapshot::Note& note = *snapshot.add_notes();
        note.set_kind(static_cast<std::uint32_t>(key.first));
        note.set_number(key.second);
        note.set_body(body);
    }
    return snapshot.SerializeAsString();
}

bool LogState::from_snapshot(const std::string& text) {
    v1::JournalSnapshot snapshot;
    const bool parsed = snapshot.ParseFromString(text);
    const auto last = parsed ? parse_stream_id(snapshot.last()) : std::nullopt;
    if (!last) {
        return false;
    }
    last_ = *last;
    for (const v1::SceneChanged& change : snapshot.changes()) {
        sums_[subject_of(change)] = change;
    }
    for (const auto& note : snapshot.notes()) {
        notes_[{static_cast<NoteKind>(note.kind()), note.number()}] = note.body();
    }
    return true;
}

}  // namespace raybundle
