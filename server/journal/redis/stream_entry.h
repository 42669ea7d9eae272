// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "journal/project_log.h"
#include "journal/redis/redis_connection.h"

namespace raybundle {

/// ID of an entry of a stream: of a change its epoch and 0, of a note the epoch that it came after
/// and 1 or more.
struct StreamId {
    std::uint64_t epoch = 0;
    std::uint64_t sequence = 0;

    [[nodiscard]] std::string text() const {
        return std::to_string(epoch) + "-" + std::to_string(sequence);
    }
    auto operator<=>(const StreamId&) const = default;
};
std::optional<StreamId> parse_stream_id(const std::string& text);

/// One entry of a project's log as it is in Redis.
struct StreamEntry {
    StreamId id;
    std::string worker;         ///< server that added it
    std::uint64_t request = 0;  ///< counts up there
    LogEntry entry;             ///< a change has the epoch of `id`
    v1::SceneChanged before;    ///< state of the change's subject before it
    bool is_change = false;     ///< also where it cannot be read: `entry.change` is unset then
};

/// Fields and values of an entry, for XADD.
std::vector<std::string> words_of(const StreamEntry& entry);
/// Entries as XRANGE gives them; what has no ID is left out.
std::vector<StreamEntry> parse_entries(const RedisReply& reply);
/// Those that XREAD of one stream gives.
std::vector<StreamEntry> entries_read(const RedisReply& reply);
/// XADD's answer to an ID that is not above the last one.
bool is_conflict(const RedisRefusal& refusal);

}  // namespace raybundle
