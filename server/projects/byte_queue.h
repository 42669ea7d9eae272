// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace raybundle {

/// What is on its way from one socket to another: bounded, so that who reads slowly holds up who
/// writes, and costs no memory.
class ByteQueue {
  public:
    static constexpr std::size_t most = 65536;

    /// What became of a call.
    enum class Outcome {
        moved,    ///< some bytes
        waits,    ///< none now
        finished  ///< the connection is over
    };

    [[nodiscard]] bool empty() const { return first_ == bytes_.size(); }
    /// Bytes that fill() would take.
    [[nodiscard]] std::size_t room() const { return most - std::min(most, bytes_.size() - first_); }
    [[nodiscard]] std::string_view view() const { return std::string_view(bytes_).substr(first_); }

    void append(std::string_view bytes) { bytes_ += bytes; }
    void drop(std::size_t count);
    /// Reads at most `limit` bytes, and no more than there is room for.
    Outcome fill(int socket, std::size_t limit = most);
    /// Writes what the socket takes.
    Outcome flush(int socket);

  private:
    std::string bytes_;
    std::size_t first_ = 0;  ///< those before it have been taken
};

}  // namespace raybundle
