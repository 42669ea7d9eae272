// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "projects/byte_queue.h"
#include "projects/descriptor.h"
#include "projects/poll_set.h"

namespace raybundle {

using FrontClock = std::chrono::steady_clock;
using FrontTime = FrontClock::time_point;

/// A request of the front's own to a project's server, one exchange over a connection of its own.
/// Nobody waits for it: step() is called until done().
class ChildRequest {
  public:
    struct Question {
        std::string method = "GET";
        std::string target;
        std::string token;   ///< empty: none
        std::string body{};  ///< JSON
    };
    ChildRequest(std::uint16_t port, const Question& question, FrontTime until);

    [[nodiscard]] bool done() const { return done_; }
    /// Of the answer; 0 where there was none in time.
    [[nodiscard]] int status() const { return status_; }
    [[nodiscard]] const std::string& body() const { return answer_; }

    void add_to(PollSet& set);
    void step(const PollSet& set, FrontTime now);

  private:
    void finish(bool complete);

    Descriptor socket_;
    FrontTime until_;
    ByteQueue out_, in_;
    std::string answer_;
    PollSet::Entry entry_ = PollSet::none;
    int status_ = 0;
    bool done_ = false;
};

/// A socket that connects to a port of this machine; not open where the system has none left.
Descriptor connect_to(std::uint16_t port);

}  // namespace raybundle
