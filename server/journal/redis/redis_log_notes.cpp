// SPDX-License-Identifier: Apache-2.0
// What reviewers leave, in the log of a project.
#include <algorithm>
#include <utility>

#include "journal/redis/redis_log.h"

namespace raybundle {
namespace {

constexpr int most_conflicts_of_a_note = 16;

}  // namespace

std::uint32_t RedisLog::new_number(NoteKind kind, std::uint32_t free) {
    if (const auto reason = outage()) {
        throw JournalError(*reason);
    }
    const auto take = [&](std::int64_t step) {
        return writer()
            .command({"HINCRBY", numbers_key_, std::to_string(static_cast<unsigned>(kind)),
                      std::to_string(step)})
            .number;
    };
    try {
        const std::int64_t number = take(1);
        return static_cast<std::uint32_t>(number >= free ? number : take(free - number));
    } catch (const RedisAway& away) {
        writer_.reset();
        throw JournalError(away.what());
    } catch (const RedisRefusal& refusal) {
        throw JournalError(refusal.what());
    }
}

/// Whether another server has kept or forgotten a note, or somebody has kept what its key asks for,
/// which whoever asks has not taken yet.
bool RedisLog::overtaken(const StreamEntry& note) const {
    const std::lock_guard lock(mutex_);
    return std::any_of(received_.begin(), received_.end(), [&](const StreamEntry& entry) {
        const bool same = entry.worker != worker_ && entry.entry.kind == note.entry.kind &&
                          entry.entry.number == note.entry.number;
        const bool asked = !note.entry.keys.empty() && !entry.entry.keys.empty() &&
                           entry.entry.keys[0].text == note.entry.keys[0].text;
        return !entry.is_change && (same || asked);
    });
}

/// Whether an entry of this server has been read already: its answer was lost.
bool RedisLog::arrived(const StreamEntry& entry) const {
    const std::lock_guard lock(mutex_);
    return std::any_of(received_.begin(), received_.end(), [&](const StreamEntry& other) {
        return other.worker == worker_ && other.request == entry.request;
    });
}

/// Adds a note behind all that has been read, so that nothing of others comes between: a note is
/// the whole of what it is about, and would undo what they have made of it. Forgetting one undoes
/// it all.
Appended RedisLog::append_note(const StreamEntry& entry) {
    const std::vector<std::string> fields = words_of(entry);
    const bool forgets = entry.entry.body.empty();
    for (int i = 0;; ++i) {
        StreamId last;
        {
            const std::lock_guard lock(mutex_);
            last = cursor_;
        }
        if (last.epoch < epoch_ || i > 0) {
            read_now();
            const std::lock_guard lock(mutex_);
            last = cursor_;
        }
        if (arrived(entry)) {
            note_write();
            return Appended::yes;
        }
        if (!forgets && overtaken(entry)) {
            return Appended::conflict;
        }
        std::vector<std::string> words{"XADD", stream_,
                                       StreamId{last.epoch, last.sequence + 1}.text()};
        words.insert(words.end(), fields.begin(), fields.end());
        try {
            writer().command(words);
            return Appended::yes;
        } catch (const RedisRefusal& refusal) {
            if (!is_conflict(refusal) || i == most_conflicts_of_a_note) {
                throw;
            }
        }
    }
}

Appended RedisLog::keep_note(NoteKind kind, std::uint32_t number, const std::string& body,
                             const std::string& key) {
    if (const auto reason = outage()) {
        throw JournalError(*reason);
    }
    StreamEntry entry;
    entry.worker = worker_;
    entry.request = ++requests_;
    entry.entry.kind = kind;
    entry.entry.number = number;
    entry.entry.body = body;
    if (!key.empty()) {
        entry.entry.keys.push_back({key});
    }
    return write(entry.request, [&](bool /*again*/) { return append_note(entry); });
}

void RedisLog::drop_note(NoteKind kind, std::uint32_t number) {
    static_cast<void>(keep_note(kind, number, {}));
    dropped_.insert({kind, number});
}

}  // namespace raybundle
