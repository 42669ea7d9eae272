// SPDX-License-Identifier: Apache-2.0
#include "net/http/snapshot_store.h"

#include <algorithm>
#include <utility>

#include "net/access/access_tokens.h"

namespace raybundle {

std::optional<std::string> SnapshotStore::add(std::string bytes, std::string_view extension,
                                              Clock::time_point now) {
    const std::size_t size = bytes.size();
    if (size > max_bytes_) {
        return std::nullopt;
    }
    std::string path = std::string(kFolder) + random_token() + std::string(extension);
    const std::lock_guard lock(mutex_);
    drop_old(size, now);
    entries_.push_back(
        {path, std::make_shared<const std::string>(std::move(bytes)), now + kLifetime});
    bytes_ += size;
    return path;
}

std::shared_ptr<const std::string> SnapshotStore::find(std::string_view path,
                                                       Clock::time_point now) const {
    const std::lock_guard lock(mutex_);
    const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                    [path](const Entry& e) { return e.path == path; });
    return entry != entries_.end() && now < entry->until ? entry->file : nullptr;
}

/// Drops what is over, then the oldest until `room` bytes are free.
void SnapshotStore::drop_old(std::size_t room, Clock::time_point now) {
    while (!entries_.empty() && (entries_.front().until <= now || bytes_ + room > max_bytes_)) {
        bytes_ -= entries_.front().file->size();
        entries_.pop_front();
    }
}

}  // namespace raybundle
