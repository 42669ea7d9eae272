// SPDX-License-Identifier: Apache-2.0
#include "link_proxy.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace raybundle {
namespace {

constexpr std::size_t kPieceBytes = 1400;       ///< as one packet
constexpr std::size_t kQueueBytes = 64 * 1024;  ///< of the bottleneck
constexpr int kSocketBytes = 16 * 1024;

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

void keep_small(int socket) {
    const int yes = 1;
    setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &kSocketBytes, sizeof kSocketBytes);
    setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &kSocketBytes, sizeof kSocketBytes);
}

}  // namespace

LinkProxy::LinkProxy(std::uint16_t server_port, Line line)
    : line_(line), server_port_(server_port), listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    keep_small(listener_);
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof address;
    if (bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
        listen(listener_, 1) != 0 ||
        getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
        throw std::runtime_error("the proxy cannot listen");
    }
    port_ = ntohs(address.sin_port);
    thread_ = std::jthread([this](const std::stop_token& token) { run(token); });
}

LinkProxy::~LinkProxy() {
    thread_.request_stop();
    thread_.join();
    close(listener_);
}

void LinkProxy::read_from(Direction& direction) {
    std::array<char, kPieceBytes> bytes{};
    const auto count = recv(direction.from, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (count == 0 || (count < 0 && errno != EAGAIN)) {
        direction.ended = true;
        return;
    }
    if (count < 0) {
        return;
    }
    auto due = Clock::now();
    if (direction.limited) {
        const double seconds = static_cast<double>(count) * 8.0 / (line_.mbit_per_s * 1e6);
        free_ = std::max(free_, due) +
                std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
        due = free_;
    }
    due += std::chrono::microseconds(static_cast<long>(line_.rtt_ms * 500.0));
    direction.delayed.push_back({due, std::string(bytes.data(), static_cast<std::size_t>(count))});
    direction.waiting += static_cast<std::size_t>(count);
}

void LinkProxy::pass(Direction& direction) {
    while (!stalled_ && !direction.delayed.empty() &&
           direction.delayed.front().due <= Clock::now()) {
        std::string& bytes = direction.delayed.front().bytes;
        const auto count =
            send(direction.to, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (count < 0) {
            direction.ended = direction.ended || errno != EAGAIN;
            return;
        }
        direction.waiting -= static_cast<std::size_t>(count);
        bytes.erase(0, static_cast<std::size_t>(count));
        if (!bytes.empty()) {
            return;
        }
        direction.delayed.pop_front();
    }
}

void LinkProxy::run(const std::stop_token& token) {
    pollfd waiting{listener_, POLLIN, 0};
    while (!token.stop_requested() && poll(&waiting, 1, 20) == 0) {
    }
    if (token.stop_requested()) {
        return;
    }
    const int client = accept(listener_, nullptr, nullptr);
    const int server = socket(AF_INET, SOCK_STREAM, 0);
    keep_small(client);
    keep_small(server);
    const sockaddr_in address = loopback(server_port_);
    bool open = connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    Direction down{server, client, true, {}, 0, false};
    Direction up{client, server, false, {}, 0, false};
    while (open && !token.stop_requested()) {
        for (Direction* direction : {&down, &up}) {
            while (!stalled_ && !direction->ended && direction->waiting < kQueueBytes) {
                const std::size_t before = direction->waiting;
                read_from(*direction);
                if (direction->waiting == before) {
                    break;
                }
            }
            pass(*direction);
        }
        open = !down.ended && !up.ended;
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    close(client);
    close(server);
}

}  // namespace raybundle
