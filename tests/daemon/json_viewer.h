// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "raw_client.h"

namespace raybundle {

using Json = nlohmann::ordered_json;

constexpr int kShortBox = 2;  ///< id of the Cornell box' short box

/// A client as the protocol describes it: JSON messages, and every frame acknowledged.
class JsonViewer {
  public:
    explicit JsonViewer(std::uint16_t port, std::string_view path = "/ws") : client_(port) {
        head_ = client_.upgrade(path);
    }

    /// Answer to the WebSocket handshake.
    [[nodiscard]] const std::string& head() const { return head_; }

    void send(const Json& message) { client_.send_text(message.dump()); }
    void send_text(const std::string& text) { client_.send_text(text); }

    /// Says hello; the welcome, or the error.
    Json join(const std::string& token = {}, int width = 160, int height = 120);

    /// Sends a request with an id of its own; returns the answer.
    Json request(Json body);

    /// The next text message that fits; others are skipped, frames acknowledged. An empty object
    /// where the connection is over or none comes in time.
    Json next(const std::function<bool(const Json&)>& fits);
    Json next_with(const std::string& key) {
        return next([&](const Json& message) { return message.contains(key); });
    }
    Json answer_to(std::uint32_t id) {
        return next([&](const Json& message) { return message.value("replyTo", 0U) == id; });
    }

    /// Header of the next frame that fits.
    Json next_frame(const std::function<bool(const Json&)>& fits);

    /// Close code of the server; 0 where it closes without one.
    int close_code();

    RawClient& raw() { return client_; }

  private:
    struct Received {
        bool is_frame = false;
        Json json;
    };
    std::optional<Received> receive();

    RawClient client_;
    std::string head_;
    std::uint32_t last_id_ = 1000;
    int close_code_ = 0;
};

}  // namespace raybundle
