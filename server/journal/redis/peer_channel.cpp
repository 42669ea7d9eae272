// SPDX-License-Identifier: Apache-2.0
#include "journal/redis/peer_channel.h"

#include <charconv>
#include <chrono>
#include <utility>

namespace raybundle {
namespace {

constexpr int peer_timeout_ms = 1000;
constexpr int listen_ms = 50;  ///< until what is to be sent is looked for again
constexpr std::chrono::milliseconds peer_retry_after(500);
constexpr const char* lasting_seconds = "5";
constexpr std::size_t most_waiting = 256;  ///< messages, either way; then the oldest are lost

void shorten(auto& list) {
    while (list.size() > most_waiting) {
        list.erase(list.begin());
    }
}

}  // namespace

PeerChannel::PeerChannel(RedisAddress address, std::string prefix, std::string worker)
    : address_(std::move(address)),
      prefix_(std::move(prefix)),
      channel_(prefix_ + "news"),
      worker_(std::move(worker)),
      thread_([this] { run(); }) {}

PeerChannel::~PeerChannel() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    woken_.notify_all();
    thread_.join();
}

void PeerChannel::publish(const std::string& body, bool lasting) {
    const std::lock_guard lock(mutex_);
    if (lasting) {
        lasting_ = body;
    } else {
        passing_.push_back(body);
        shorten(passing_);
    }
}

std::vector<PeerNews> PeerChannel::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(received_, {});
}

void PeerChannel::run() {
    std::unique_lock lock(mutex_);
    while (!stop_) {
        lock.unlock();
        try {
            exchange();
        } catch (const std::runtime_error&) {
            // RedisLog says that Redis is away.
        }
        lock.lock();
        woken_.wait_for(lock, peer_retry_after, [this] { return stop_; });
    }
}

/// Until the end, or until Redis does not answer.
void PeerChannel::exchange() {
    RedisConnection sender(address_, peer_timeout_ms);
    RedisConnection listener(address_, peer_timeout_ms);
    // Small, and of this server alone: viewers' numbers are made of it.
    const auto number = static_cast<std::uint32_t>(
        sender.command({"HINCRBY", prefix_ + "numbers", "server", "1"}).number);
    listener.command({"SUBSCRIBE", channel_});
    while (send_pending(sender, number)) {
        take_in(listener.receive(listen_ms));
    }
}

/// False: the server ends.
bool PeerChannel::send_pending(RedisConnection& connection, std::uint32_t number) {
    std::string lasting;
    std::deque<std::string> passing;
    {
        const std::lock_guard lock(mutex_);
        if (stop_) {
            return false;
        }
        lasting = std::exchange(lasting_, {});
        passing = std::exchange(passing_, {});
    }
    const std::string head = worker_ + " " + std::to_string(number) + "\n";
    for (const std::string& body : passing) {
        connection.command({"PUBLISH", channel_, head + body});
    }
    if (!lasting.empty()) {
        connection.command({"SET", prefix_ + "presence:" + std::to_string(number), lasting, "EX",
                            lasting_seconds});
        connection.command({"PUBLISH", channel_, head + lasting});
    }
    return true;
}

void PeerChannel::take_in(const RedisReply& message) {
    if (message.list.size() != 3 || message.list[0].text != "message") {
        return;
    }
    const std::string& text = message.list[2].text;
    const std::size_t space = text.find(' ');
    const std::size_t end = text.find('\n');
    if (space == std::string::npos || end == std::string::npos || space > end ||
        text.compare(0, space, worker_) == 0) {
        return;
    }
    PeerNews news;
    const auto parsed = std::from_chars(text.data() + space + 1, text.data() + end, news.server);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + end) {
        return;
    }
    news.body = text.substr(end + 1);
    const std::lock_guard lock(mutex_);
    received_.push_back(std::move(news));
    shorten(received_);
}

}  // namespace raybundle
