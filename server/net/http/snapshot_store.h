// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace raybundle {

/// Finished snapshots in memory, each under a path of 256 random bits that is right for a quarter
/// of an hour. Old ones go where new ones need their room. Any thread.
class SnapshotStore {
  public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::string_view kFolder = "/snapshots/";
    static constexpr std::chrono::minutes kLifetime{15};

    explicit SnapshotStore(std::size_t max_bytes) : max_bytes_(max_bytes) {}

    /// Its path, e.g. "/snapshots/9f...e1.exr"; nothing where it is larger than the store.
    std::optional<std::string> add(std::string bytes, std::string_view extension,
                                   Clock::time_point now = Clock::now());

    /// The file, or null.
    [[nodiscard]] std::shared_ptr<const std::string> find(
        std::string_view path, Clock::time_point now = Clock::now()) const;

  private:
    struct Entry {
        std::string path;
        std::shared_ptr<const std::string> file;
        Clock::time_point until;
    };

    void drop_old(std::size_t room, Clock::time_point now);

    const std::size_t max_bytes_;
    mutable std::mutex mutex_;
    std::list<Entry> entries_;  ///< oldest first
    std::size_t bytes_ = 0;
};

}  // namespace raybundle
