// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "journal/project_log.h"
#include "journal/redis/redis_connection.h"

namespace raybundle {

/// What servers of a project tell each other and nobody keeps: who is here, where somebody points.
/// By Redis' channels; what comes while Redis is away is lost. A thread of its own.
class PeerChannel {
  public:
    /// prefix: of the project's keys. worker: name of this server, which nobody else has.
    PeerChannel(RedisAddress address, std::string prefix, std::string worker);
    ~PeerChannel();
    PeerChannel(const PeerChannel&) = delete;
    PeerChannel& operator=(const PeerChannel&) = delete;

    /// Tells all others. lasting: also newcomers may read it for some seconds; of these only the
    /// newest is sent. Any thread.
    void publish(const std::string& body, bool lasting);
    /// What others have told. Any thread.
    std::vector<PeerNews> take();

  private:
    void run();
    void exchange();
    bool send_pending(RedisConnection& connection, std::uint32_t number);
    void take_in(const RedisReply& message);

    RedisAddress address_;
    std::string prefix_, channel_, worker_;

    std::mutex mutex_;
    std::condition_variable woken_;
    bool stop_ = false;
    std::string lasting_;              ///< to be sent; empty: nothing
    std::deque<std::string> passing_;  ///< likewise
    std::vector<PeerNews> received_;
    std::thread thread_;
};

}  // namespace raybundle
