// SPDX-License-Identifier: Apache-2.0
#include "journal/redis/redis_connection.h"

#include <hiredis/hiredis.h>
#include <poll.h>
#include <sys/time.h>

#include <cerrno>

namespace raybundle {
namespace {

using ReplyPointer = std::unique_ptr<redisReply, void (*)(void*)>;

timeval duration(int ms) {
    constexpr int ms_per_s = 1000;
    return {ms / ms_per_s, (ms % ms_per_s) * ms_per_s};
}

RedisReply converted(const redisReply& reply) {
    RedisReply result;
    switch (reply.type) {
        case REDIS_REPLY_INTEGER:
            result.kind = RedisReply::Kind::number;
            result.number = reply.integer;
            break;
        case REDIS_REPLY_STRING:
        case REDIS_REPLY_STATUS:
        case REDIS_REPLY_ERROR:
            result.kind = RedisReply::Kind::text;
            result.text.assign(reply.str, static_cast<std::size_t>(reply.len));
            break;
        case REDIS_REPLY_ARRAY:
            result.kind = RedisReply::Kind::list;
            for (std::size_t i = 0; i < reply.elements; ++i) {
                result.list.push_back(converted(*reply.element[i]));
            }
            break;
        default:
            break;
    }
    return result;
}

}  // namespace

RedisConnection::RedisConnection(const RedisAddress& address, int timeout_ms)
    : where_("Redis at " + address.text()),
      context_(redisConnectWithTimeout(address.host.c_str(), address.port, duration(timeout_ms)),
               &redisFree) {
    if (context_ == nullptr) {
        throw RedisAway(where_ + ": no memory");
    }
    if (context_->err != 0 || redisSetTimeout(context_.get(), duration(timeout_ms)) != REDIS_OK) {
        fail();
    }
    redisEnableKeepAlive(context_.get());
    if (!address.password.empty() && address.user.empty()) {
        command({"AUTH", address.password});
    } else if (!address.password.empty()) {
        command({"AUTH", address.user, address.password});
    }
}

RedisConnection::~RedisConnection() = default;

void RedisConnection::fail() const {
    const bool late = context_->err == REDIS_ERR_IO && (errno == EAGAIN || errno == EWOULDBLOCK);
    throw RedisAway(where_ + (late ? " does not answer" : std::string(": ") + context_->errstr));
}

RedisReply RedisConnection::command(const std::vector<std::string>& words) {
    std::vector<const char*> begins;
    std::vector<std::size_t> lengths;
    for (const std::string& word : words) {
        begins.push_back(word.data());
        lengths.push_back(word.size());
    }
    const ReplyPointer reply(
        static_cast<redisReply*>(redisCommandArgv(context_.get(), static_cast<int>(words.size()),
                                                  begins.data(), lengths.data())),
        &freeReplyObject);
    if (reply == nullptr) {
        fail();
    }
    if (reply->type == REDIS_REPLY_ERROR) {
        throw RedisRefusal(where_ + ": " +
                           std::string(reply->str, static_cast<std::size_t>(reply->len)));
    }
    return converted(*reply);
}

RedisReply RedisConnection::receive(int wait_ms) {
    void* raw = nullptr;
    if (redisReaderGetReply(context_->reader, &raw) != REDIS_OK) {
        fail();
    }
    pollfd ready{context_->fd, POLLIN, 0};
    if (raw == nullptr) {
        if (poll(&ready, 1, wait_ms) <= 0) {
            return {};
        }
        if (redisGetReply(context_.get(), &raw) != REDIS_OK) {
            fail();
        }
    }
    const ReplyPointer reply(static_cast<redisReply*>(raw), &freeReplyObject);
    return converted(*reply);
}

}  // namespace raybundle
