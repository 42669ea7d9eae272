// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace raybundle {

/// A file that lines are appended to, each by one call of the system, so that it may be renamed or
/// emptied meanwhile. A line that cannot be written is counted, and said once in the log. Any
/// thread.
class AuditFile {
  public:
    /// Makes the file where it is missing, for its owner alone. Throws std::runtime_error.
    explicit AuditFile(std::string path);
    ~AuditFile();
    AuditFile(const AuditFile&) = delete;
    AuditFile& operator=(const AuditFile&) = delete;

    void append(std::string line);

    /// The file may have another name now: opens its own again. Where that fails the old one stays.
    void reopen();

    [[nodiscard]] std::uint64_t failures() const { return failures_; }

  private:
    void note_result(int error);

    const std::string path_;
    std::mutex mutex_;
    int file_ = -1;
    bool torn_ = false;     ///< the last line has no end
    bool failing_ = false;  ///< the last line could not be written
    std::atomic<std::uint64_t> failures_{0};
};

}  // namespace raybundle
