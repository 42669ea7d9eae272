// SPDX-License-Identifier: Apache-2.0
#include "raw_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace raybundle {
namespace {

/// Only what hangs takes so long, with sanitizers on a busy machine either.
constexpr int kTimeoutMs = 300000;
constexpr int kPing = 9;
constexpr int kPong = 10;

}  // namespace

int RawFrame::close_code() const {
    if (opcode != 8 || payload.size() < 2) {
        return 0;
    }
    return 256 * static_cast<unsigned char>(payload[0]) + static_cast<unsigned char>(payload[1]);
}

RawClient::RawClient(std::uint16_t port, int receive_buffer_bytes)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_buffer_bytes > 0) {
        setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes,
                   sizeof receive_buffer_bytes);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
        throw std::runtime_error("cannot connect");
    }
}

RawClient::~RawClient() {
    if (socket_ >= 0) {
        close(socket_);
    }
}

void RawClient::reset() {
    const linger abort{1, 0};
    setsockopt(socket_, SOL_SOCKET, SO_LINGER, &abort, sizeof abort);
    close(socket_);
    socket_ = -1;
}

void RawClient::send(std::string_view bytes) {
    while (!bytes.empty()) {
        const auto count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (count <= 0) {
            return;  // closed by the server; the test sees that when it reads
        }
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
}

bool RawClient::fill() {
    return fill(kTimeoutMs);
}

bool RawClient::fill(int timeout_ms) {
    pollfd ready{socket_, POLLIN, 0};
    if (poll(&ready, 1, timeout_ms) <= 0) {
        return false;
    }
    std::array<char, 65536> bytes{};
    const auto count = recv(socket_, bytes.data(), bytes.size(), 0);
    if (count <= 0) {
        return false;
    }
    buffer_.append(bytes.data(), static_cast<std::size_t>(count));
    return true;
}

std::optional<std::string> RawClient::take(std::size_t size) {
    while (buffer_.size() < size) {
        if (!fill()) {
            return std::nullopt;
        }
    }
    std::string bytes = buffer_.substr(0, size);
    buffer_.erase(0, size);
    return bytes;
}

std::string RawClient::read_until(std::string_view end) {
    std::size_t found = 0;
    while ((found = buffer_.find(end)) == std::string::npos) {
        if (!fill()) {
            return *take(buffer_.size());
        }
    }
    return *take(found + end.size());
}

std::string RawClient::read_all() {
    while (fill()) {
    }
    return *take(buffer_.size());
}

std::string RawClient::read_for(std::chrono::milliseconds time) {
    fill(static_cast<int>(time.count()));
    return *take(buffer_.size());
}

std::string RawClient::upgrade(std::string_view path, std::string_view headers) {
    send("GET " + std::string(path) +
         " HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
         std::string(headers) + "\r\n");
    return read_until("\r\n\r\n");
}

void RawClient::send_frame(int opcode, std::string_view payload, bool final) {
    constexpr std::string_view kMask = "\x11\x22\x33\x44";
    std::string frame(1, static_cast<char>((final ? 0x80 : 0) | opcode));
    const std::size_t size = payload.size();
    const int length_bytes = size < 126 ? 0 : (size < 65536 ? 2 : 8);
    const std::size_t length_code = length_bytes == 0 ? size : (length_bytes == 2 ? 126U : 127U);
    frame += static_cast<char>(0x80U | length_code);
    for (int byte = length_bytes - 1; byte >= 0; --byte) {
        frame += static_cast<char>(size >> (8 * static_cast<unsigned>(byte)));
    }
    frame += kMask;
    for (std::size_t i = 0; i < size; ++i) {
        frame += static_cast<char>(payload[i] ^ kMask[i % 4]);
    }
    send(frame);
}

std::optional<RawFrame> RawClient::read_frame() {
    const auto head = take(2);
    if (!head) {
        return std::nullopt;
    }
    const auto first = static_cast<unsigned char>((*head)[0]);
    std::size_t size = static_cast<unsigned char>((*head)[1]);
    if (size >= 126) {
        const auto length = take(size == 126 ? 2 : 8);
        if (!length) {
            return std::nullopt;
        }
        size = 0;
        for (const char byte : *length) {
            size = 256 * size + static_cast<unsigned char>(byte);
        }
    }
    auto payload = take(size);
    if (!payload) {
        return std::nullopt;
    }
    return RawFrame{(first & 0x80U) != 0, first & 0x0F, std::move(*payload)};
}

std::optional<RawFrame> RawClient::read_message() {
    std::optional<RawFrame> message;
    while (auto frame = read_frame()) {
        if (frame->opcode == kPing) {
            send_frame(kPong, frame->payload);
            continue;
        }
        if (frame->opcode == kPong) {
            continue;
        }
        if (frame->opcode != 0 || !message) {
            message = std::move(frame);
        } else {
            message->payload += frame->payload;
            message->final = frame->final;
        }
        if (message->final) {
            return message;
        }
    }
    return std::nullopt;
}

bool RawClient::closed() {
    pollfd ready{socket_, POLLIN, 0};
    while (poll(&ready, 1, kTimeoutMs) > 0) {
        char byte = 0;
        if (recv(socket_, &byte, 1, 0) <= 0) {
            return true;
        }
    }
    return false;
}

std::string http_exchange(std::uint16_t port, std::string_view request) {
    RawClient client(port);
    client.send(request);
    return client.read_all();
}

}  // namespace raybundle
