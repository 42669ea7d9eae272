// SPDX-License-Identifier: Apache-2.0
#include "projects/byte_queue.h"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace raybundle {
namespace {

ByteQueue::Outcome outcome_of_error() {
    return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR ? ByteQueue::Outcome::waits
                                                                     : ByteQueue::Outcome::finished;
}

}  // namespace

void ByteQueue::drop(std::size_t count) {
    first_ += std::min(count, bytes_.size() - first_);
    if (first_ == bytes_.size()) {
        bytes_.clear();
        first_ = 0;
    } else if (first_ > most / 2) {
        bytes_.erase(0, first_);
        first_ = 0;
    }
}

ByteQueue::Outcome ByteQueue::fill(int socket, std::size_t limit) {
    std::array<char, most> bytes;  // NOLINT: recv() writes what is read
    const std::size_t size = std::min(limit, room());
    if (size == 0) {
        return Outcome::waits;
    }
    const auto count = recv(socket, bytes.data(), size, MSG_DONTWAIT);
    if (count < 0) {
        return outcome_of_error();
    }
    bytes_.append(bytes.data(), static_cast<std::size_t>(count));
    return count > 0 ? Outcome::moved : Outcome::finished;
}

ByteQueue::Outcome ByteQueue::flush(int socket) {
    if (empty()) {
        return Outcome::waits;
    }
    const std::string_view bytes = view();
    const auto count = send(socket, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count < 0) {
        return outcome_of_error();
    }
    drop(static_cast<std::size_t>(count));
    return Outcome::moved;
}

}  // namespace raybundle
