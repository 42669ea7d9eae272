// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <thread>

namespace raybundle {

/// A bad line in front of a server on this machine: one TCP connection, whose bytes to the client
/// pass a token bucket of given rate and both ways a delay; and which can be cut off for a while.
/// Buffers stay small, so that the server feels the line.
class LinkProxy {
  public:
    struct Line {
        double mbit_per_s = 20.0;
        double rtt_ms = 20.0;
    };

    LinkProxy(std::uint16_t server_port, Line line);
    ~LinkProxy();
    LinkProxy(const LinkProxy&) = delete;
    LinkProxy& operator=(const LinkProxy&) = delete;

    [[nodiscard]] std::uint16_t port() const { return port_; }

    /// While stalled nothing passes.
    void set_stalled(bool stalled) { stalled_ = stalled; }

  private:
    using Clock = std::chrono::steady_clock;
    struct Piece {
        Clock::time_point due;
        std::string bytes;
    };
    struct Direction {
        int from = -1, to = -1;
        bool limited = false;
        std::deque<Piece> delayed;
        std::size_t waiting = 0;
        bool ended = false;
    };

    void run(const std::stop_token& token);
    void read_from(Direction& direction);
    void pass(Direction& direction);

    Line line_;
    std::uint16_t server_port_;
    std::uint16_t port_ = 0;
    int listener_ = -1;
    std::atomic<bool> stalled_{false};
    Clock::time_point free_;  ///< when the bottleneck has passed what it has taken
    std::jthread thread_;
};

}  // namespace raybundle
