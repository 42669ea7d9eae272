// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/http/http_response.h"
#include "net/network_state.h"
#include "net/rest/rest_route.h"
#include "net/ws/viewer_link.h"

namespace raybundle {

/// A request among the session's connections: comes in as a caller (ClientEvent::caller), says its
/// messages, hears the answer, and leaves when it is destroyed. Network thread only.
class RestCall {
  public:
    struct Caller {
        v1::Role role = v1::VIEWER;
        std::string name;     ///< that others see
        std::string token;    ///< name of its token; empty: none
        std::string address;  ///< see request_peer()
    };

    /// messages: with ids; the answer to the last one is that to the request.
    RestCall(NetworkState& state, RestMatch match, const Caller& caller,
             std::vector<v1::ClientMessage> messages);
    ~RestCall();
    RestCall(const RestCall&) = delete;
    RestCall& operator=(const RestCall&) = delete;

    /// Hears what has been said since the last time. True where there is an answer.
    bool listen();

    /// The answer; null before.
    [[nodiscard]] const HttpResponse* answer() const { return answer_ ? &*answer_ : nullptr; }
    /// JSON of the newest snapshotProgress; empty where there is none.
    [[nodiscard]] const std::string& progress() const { return progress_; }
    [[nodiscard]] const RestRoute& route() const { return *match_.route; }

  private:
    void hear(std::string_view text);
    void leave();

    NetworkState& state_;
    RestMatch match_;
    std::shared_ptr<ViewerLink> link_;  ///< null once it has left
    std::uint32_t last_id_ = 0;         ///< of its messages
    std::optional<HttpResponse> answer_;
    std::string progress_;
};

}  // namespace raybundle
