// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace raybundle {

/// A frame of RFC 6455 as received: opcode and payload.
struct RawFrame {
    bool final = true;
    int opcode = 0;
    std::string payload;

    /// Code of a close frame, 0 where it has none.
    [[nodiscard]] int close_code() const;
};

/// Whether a text contains a part.
inline bool has(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

/// TCP connection that speaks HTTP and WebSocket byte by byte, so that tests can also misbehave.
class RawClient {
  public:
    explicit RawClient(std::uint16_t port, int receive_buffer_bytes = 0);
    ~RawClient();
    RawClient(const RawClient&) = delete;
    RawClient& operator=(const RawClient&) = delete;

    void send(std::string_view bytes);

    /// Everything up to and including `end`; what has come where the time or the connection is
    /// over.
    std::string read_until(std::string_view end);

    /// Everything until the server closes.
    std::string read_all();

    /// What comes within a time; empty where nothing does.
    std::string read_for(std::chrono::milliseconds time);

    /// WebSocket handshake; returns the answer's head. `headers` are added to it.
    std::string upgrade(std::string_view path = "/ws",
                        std::string_view headers = "Sec-WebSocket-Protocol: raybundle.v1\r\n");

    void send_frame(int opcode, std::string_view payload, bool final = true);
    void send_text(std::string_view text) { send_frame(1, text); }

    /// Next frame; nothing where the connection is over or the time is up.
    std::optional<RawFrame> read_frame();

    /// Next text or binary message, fragments put together; pings are answered.
    std::optional<RawFrame> read_message();

    /// Whether the server has closed the connection, waiting for it.
    bool closed();

    [[nodiscard]] int socket() const { return socket_; }

    void reset();  ///< closes abruptly, with a TCP reset

  private:
    bool fill();  ///< reads more into buffer_; false: closed or time is up
    bool fill(int timeout_ms);
    std::optional<std::string> take(std::size_t size);

    int socket_ = -1;
    std::string buffer_;
};

/// One whole HTTP/1.1 exchange.
std::string http_exchange(std::uint16_t port, std::string_view request);

}  // namespace raybundle
