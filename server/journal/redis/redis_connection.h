// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

struct redisContext;

namespace raybundle {

/// Where Redis is, and as whom to speak to it.
struct RedisAddress {
    std::string host;
    std::uint16_t port = 6379;
    std::string user;      ///< empty: Redis' default user
    std::string password;  ///< empty: none is sent

    [[nodiscard]] std::string text() const { return host + ":" + std::to_string(port); }
};

/// Redis does not answer: whether the command was carried out is not known.
class RedisAway : public std::runtime_error {
    using std::runtime_error::runtime_error;
};
/// Redis has answered by an error: the command was not carried out.
class RedisRefusal : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An answer of Redis.
struct RedisReply {
    enum class Kind : std::uint8_t { nothing, text, number, list };
    Kind kind = Kind::nothing;
    std::string text;
    std::int64_t number = 0;
    std::vector<RedisReply> list;
};

/// One connection by TCP, without TLS. One thread.
class RedisConnection {
  public:
    /// Connects and logs in. timeout_ms: of each step, and of each answer beyond what the command
    /// itself waits. Throws RedisAway; RedisRefusal for a wrong password.
    RedisConnection(const RedisAddress& address, int timeout_ms);
    ~RedisConnection();
    RedisConnection(const RedisConnection&) = delete;
    RedisConnection& operator=(const RedisConnection&) = delete;

    /// Carries out a command of binary words. Throws RedisAway, after which the connection is of no
    /// use any more, and RedisRefusal.
    RedisReply command(const std::vector<std::string>& words);

    /// The next message of a channel, or one of kind `nothing` where none comes in wait_ms. Throws
    /// RedisAway.
    RedisReply receive(int wait_ms);

  private:
    [[noreturn]] void fail() const;

    std::string where_;
    std::unique_ptr<redisContext, void (*)(redisContext*)> context_;
};

}  // namespace raybundle
