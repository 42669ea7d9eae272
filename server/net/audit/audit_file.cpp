// SPDX-License-Identifier: Apache-2.0
#include "net/audit/audit_file.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace raybundle {
namespace {

/// O_NONBLOCK: a pipe that nobody reads stops nobody. Files do not know it.
int open_to_append(const std::string& path) {
    constexpr mode_t owner_only = 0600;
    return open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK,
                owner_only);
}

std::string words(int error) {
    return std::generic_category().message(error);
}

}  // namespace

AuditFile::AuditFile(std::string path) : path_(std::move(path)), file_(open_to_append(path_)) {
    if (file_ < 0) {
        throw std::runtime_error(path_ + ": cannot be written: " + words(errno));
    }
}

AuditFile::~AuditFile() {
    close(file_);
}

void AuditFile::append(std::string line) {
    line += '\n';
    const std::lock_guard lock(mutex_);
    if (torn_) {
        line.insert(line.begin(), '\n');
    }
    const ssize_t count = write(file_, line.data(), line.size());
    const int error = count < 0 ? errno : ENOSPC;
    if (count > 0) {
        torn_ = static_cast<std::size_t>(count) < line.size();
    }
    note_result(count == static_cast<ssize_t>(line.size()) ? 0 : error);
}

void AuditFile::note_result(int error) {
    failures_ += error == 0 ? 0 : 1;
    const bool failed = std::exchange(failing_, error != 0);
    if (error != 0 && !failed) {
        spdlog::error("audit log: {}: {}; raybundle_audit_failures_total counts what is missing",
                      path_, words(error));
    } else if (error == 0 && failed) {
        spdlog::info("audit log: {} can be written again", path_);
    }
}

void AuditFile::reopen() {
    const int fresh = open_to_append(path_);
    const int error = errno;
    const std::lock_guard lock(mutex_);
    if (fresh < 0) {
        spdlog::error("audit log: {}: {}; the old file stays in use", path_, words(error));
        return;
    }
    close(std::exchange(file_, fresh));
    torn_ = false;
}

}  // namespace raybundle
