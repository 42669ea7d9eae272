// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "journal/redis/redis_connection.h"
#include "test_folder.h"

namespace raybundle {

/// Debian's redis-server on a free port of this machine, with its data in a folder of its own: what
/// it has answered is on disk (appendonly, appendfsync always).
class RedisServer {
  public:
    /// options: further ones of redis-server. Throws std::runtime_error where there is none.
    explicit RedisServer(std::vector<std::string> options = {});
    ~RedisServer();
    RedisServer(const RedisServer&) = delete;
    RedisServer& operator=(const RedisServer&) = delete;

    /// kill -9, and waits for the end.
    void kill_it();
    /// Starts it again on the same port, and waits until it answers.
    void start();
    /// Removes what it has on disk.
    void lose_data() const;
    /// Stops it for a while: it takes connections, and answers nothing.
    void freeze() const;
    void thaw() const;

    [[nodiscard]] RedisAddress address() const;
    [[nodiscard]] std::string text() const { return address().text(); }
    RedisReply command(const std::vector<std::string>& words) const;

  private:
    [[nodiscard]] bool answers() const;

    TestFolder folder_;
    std::vector<std::string> options_;
    std::uint16_t port_ = 0;
    pid_t process_ = -1;
};

}  // namespace raybundle
