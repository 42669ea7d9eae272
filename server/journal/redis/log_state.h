// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "journal/change_sum.h"
#include "journal/redis/stream_entry.h"

namespace raybundle {

/// What the entries of a log come to: the sum of the changes of each subject, and the notes.
class LogState {
  public:
    /// Takes in the next entry; one that it has already changes nothing.
    void apply(const StreamEntry& entry);

    /// ID of the last entry that is in it.
    [[nodiscard]] const StreamId& last() const { return last_; }
    /// In order of epochs. One that could not be read has its epoch only.
    [[nodiscard]] std::vector<v1::SceneChanged> changes() const;
    [[nodiscard]] std::vector<std::string> notes(NoteKind kind) const;

    [[nodiscard]] std::string to_snapshot() const;
    /// False where it cannot be read; nothing has changed then.
    bool from_snapshot(const std::string& text);

  private:
    StreamId last_;
    std::map<ChangeSubject, v1::SceneChanged> sums_;
    std::map<std::pair<NoteKind, std::uint32_t>, std::string> notes_;
};

}  // namespace raybundle
