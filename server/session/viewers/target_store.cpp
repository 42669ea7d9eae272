// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/target_store.h"

#include <algorithm>

namespace raybundle {

TargetStore::TargetStore(ChangeLog& log) : log_(log) {
    for (const std::string& body : log.notes(NoteKind::target)) {
        v1::JournalTarget note;
        if (note.ParseFromString(body)) {
            next_number_ = std::max(next_number_, note.number() + 1);
            targets_[note.name()] = note;
        }
    }
}

void TargetStore::follow(std::uint32_t number, const std::string& body) {
    v1::JournalTarget note;
    if (!body.empty() && note.ParseFromString(body)) {
        next_number_ = std::max(next_number_, number + 1);
        targets_[note.name()] = note;
    } else {
        std::erase_if(targets_, [number](const auto& t) { return t.second.number() == number; });
    }
}

/// Forgets the target of a name; true where there is none afterwards.
bool TargetStore::drop(const std::string& name) {
    const auto found = targets_.find(name);
    if (found == targets_.end()) {
        return true;
    }
    if (!log_.keep_note(NoteKind::target, found->second.number(), {})) {
        return false;
    }
    targets_.erase(found);
    return true;
}

bool TargetStore::keep(const std::string& name, const v1::SetTarget& target) {
    if (name.empty()) {
        return true;
    }
    if (target.goal_case() == v1::SetTarget::GOAL_NOT_SET) {
        return drop(name);
    }
    const auto earlier = targets_.find(name);
    if (earlier != targets_.end() &&
        earlier->second.target().SerializeAsString() == target.SerializeAsString()) {
        return true;
    }
    if (earlier == targets_.end() && targets_.size() >= max_targets) {
        const auto oldest = std::min_element(
            targets_.begin(), targets_.end(),
            [](const auto& a, const auto& b) { return a.second.number() < b.second.number(); });
        if (!drop(std::string(oldest->first))) {
            return false;
        }
    }
    v1::JournalTarget note;
    const auto number = earlier == targets_.end() ? log_.new_number(NoteKind::target, next_number_)
                                                  : std::optional(earlier->second.number());
    if (!number) {
        return false;
    }
    note.set_number(*number);
    note.set_name(name);
    *note.mutable_target() = target;
    if (!log_.keep_note(NoteKind::target, note.number(), note.SerializeAsString())) {
        return false;
    }
    next_number_ = std::max(next_number_, note.number() + 1);
    targets_[name] = std::move(note);
    return true;
}

const v1::SetTarget* TargetStore::of(const std::string& name) const {
    const auto found = targets_.find(name);
    return found == targets_.end() ? nullptr : &found->second.target();
}

}  // namespace raybundle
