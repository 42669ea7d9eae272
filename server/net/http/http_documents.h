// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "net/http/document.h"
#include "net/http/http_response.h"
#include "net/network_state.h"

struct lws;

namespace raybundle {

/// Documents on their way: asked for at the session, answered when they are made. Network thread
/// only, except that results arrive from other threads.
class HttpDocuments {
  public:
    static constexpr std::size_t most_running = 4;
    static constexpr std::uint64_t most_bytes = 16U << 20U;  ///< of a PUT

    /// `wake` makes the network thread look at finished(); any thread calls it.
    HttpDocuments(NetworkState& state, std::function<void()> wake)
        : state_(state), wake_(std::move(wake)) {}

    /// The refusal, or nothing where the answer comes later. length: of the body of a PUT.
    std::optional<HttpResponse> begin(lws* connection, DocumentRequest request,
                                      std::optional<std::uint64_t> length);
    /// Whether a body of this connection is for us.
    [[nodiscard]] bool takes_body(lws* connection) const;
    void write(lws* connection, std::string_view bytes);
    void complete(lws* connection);
    /// The time for the body is over: the answer that says so, or nothing where it is complete.
    std::optional<HttpResponse> expire(lws* connection);
    /// Answers that have come since the last call.
    std::vector<std::pair<lws*, HttpResponse>> finished();
    /// The server is stopping: finished() has a refusal for each, and begin() has none but such.
    void say_goodbye();
    void forget(lws* connection) { running_.erase(connection); }

  private:
    struct Answer {
        std::mutex mutex;
        std::optional<DocumentResult> result;
    };
    struct Running {
        DocumentRequest request;
        std::uint64_t missing = 0;  ///< bytes of the body that have not come
        bool asked = false;
        std::shared_ptr<Answer> answer = std::make_shared<Answer>();
    };
    void ask(Running& running);

    NetworkState& state_;
    std::function<void()> wake_;
    bool stopping_ = false;
    std::map<lws*, Running> running_;
};

}  // namespace raybundle
