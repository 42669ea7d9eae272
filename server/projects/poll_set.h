// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <vector>

namespace raybundle {

/// What one round of the front waits for. Everybody adds descriptors, poll() waits, everybody looks
/// at what has become of its own.
class PollSet {
  public:
    using Entry = std::size_t;
    static constexpr Entry none = static_cast<Entry>(-1);

    void clear() { entries_.clear(); }

    /// Nothing is waited for where `events` is 0, not even the end of the connection, which would
    /// otherwise be told again and again.
    Entry add(int descriptor, short events) {
        if (descriptor < 0 || events == 0) {
            return none;
        }
        entries_.push_back({descriptor, events, 0});
        return entries_.size() - 1;
    }

    void wait(int timeout_ms) { poll(entries_.data(), entries_.size(), timeout_ms); }

    /// Whether there is something to read, the end and errors included.
    [[nodiscard]] bool readable(Entry entry) const {
        return has(entry, POLLIN | POLLHUP | POLLERR | POLLNVAL);
    }
    [[nodiscard]] bool writable(Entry entry) const {
        return has(entry, POLLOUT | POLLHUP | POLLERR | POLLNVAL);
    }

  private:
    [[nodiscard]] bool has(Entry entry, int events) const {
        return entry < entries_.size() && (entries_[entry].revents & events) != 0;
    }

    std::vector<pollfd> entries_;
};

}  // namespace raybundle
