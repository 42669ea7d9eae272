// SPDX-License-Identifier: Apache-2.0
#include "journal/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace raybundle {

FileLock::FileLock(const std::string& file)
    : descriptor_(open((file + "-lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    if (descriptor_ < 0) {
        throw std::system_error(errno, std::generic_category());
    }
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        const int reason = errno;
        close(descriptor_);
        throw std::system_error(reason, std::generic_category());
    }
}

FileLock::~FileLock() {
    close(descriptor_);
}

}  // namespace raybundle
