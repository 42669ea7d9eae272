// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace raybundle {

/// A viewer of 640x360 that acknowledges every frame, on a thread of its own.
class SoakViewer {
  public:
    /// A moving one turns about the scene: it sends a camera, waits for the frame that answers it,
    /// and so on, at most 20 times a second.
    SoakViewer(std::uint16_t port, bool moving, int number);

    /// Ends it; a viewer that has lost its connection or was refused says why, else empty.
    std::string stop();

    /// Frames received so far.
    [[nodiscard]] std::uint64_t frames() const { return frames_; }
    /// Milliseconds from camera message to decoded header of the frame that answers it.
    [[nodiscard]] std::vector<double> latencies();

  private:
    void run(std::uint16_t port, bool moving, int number, const std::stop_token& token);

    std::atomic<std::uint64_t> frames_{0};
    std::mutex mutex_;
    std::vector<double> latencies_;
    std::string problem_;
    std::jthread thread_;
};

/// Clients that do harm: connections that say hello and then read nothing, and others that come and
/// break off in the middle of a message, several times a second.
class HostileClients {
  public:
    HostileClients(std::uint16_t port, int stalled, int flapping);
    ~HostileClients();
    HostileClients(const HostileClients&) = delete;
    HostileClients& operator=(const HostileClients&) = delete;

    /// Connections that the flapping ones have made.
    [[nodiscard]] std::uint64_t flaps() const { return flaps_; }

  private:
    class Stalled;

    std::vector<std::unique_ptr<Stalled>> stalled_;
    std::atomic<std::uint64_t> flaps_{0};
    std::vector<std::jthread> flapping_;
};

}  // namespace raybundle
