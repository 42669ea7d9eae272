// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace raybundle {

/// A lock on a file beside `file`, "FILE-lock", which goes with the process however that ends. The
/// locks of SQLite cannot serve for this: one that keeps a second server out keeps out those who
/// make a backup, too.
class FileLock {
  public:
    /// Throws std::system_error: std::errc::resource_unavailable_try_again where somebody has it.
    explicit FileLock(const std::string& file);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

  private:
    int descriptor_;
};

}  // namespace raybundle
