// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "net/http/http_response.h"
#include "net/network_state.h"
#include "net/rest/rest_call.h"
#include "net/rest/rest_requests.h"

struct lws;

namespace raybundle {

/// Of a request: what its line and headers say.
struct RestHead {
    HttpMethod method = HttpMethod::get;
    std::string path;           ///< decoded, without query
    std::string query;          ///< decoded, "wait=5&name=Ada"
    std::string authorization;  ///< header, as are the next three
    std::string content_type;
    std::string origin;
    std::string host;
    std::optional<std::uint64_t> length{};  ///< of the body; none: there is no body
    bool chunked = false;                   ///< a body without length
    std::string peer;                       ///< who asks, see request_peer()
    std::string traceparent{};              ///< header of W3C Trace Context
};

/// Answers what is asked below /api: the interface beside the socket for what is no stream.
/// Knows connections by their numbers only, so that tests drive it. Network thread only.
class RestService {
  public:
    static constexpr std::size_t most_of_one = 8;    ///< requests that one caller has running
    static constexpr std::size_t most_running = 32;  ///< of all callers
    static constexpr double body_s = 10.0;           ///< for a body to come
    static constexpr double most_wait_s = 30.0;      ///< for an answer, before there is a 202

    explicit RestService(NetworkState& state) : state_(state) {}

    /// An answer, which may have to wait (wrong tokens), or what comes next.
    struct Outcome {
        std::optional<HttpResponse> response{};
        double delay_ms = 0.0;
        double time_s = 0.0;  ///< without a response: when expire() is to be called
    };
    Outcome begin(lws* connection, RestHead head);

    /// Whether a body of this connection is for us.
    [[nodiscard]] bool takes_body(lws* connection) const { return running_.contains(connection); }
    void write(lws* connection, std::string_view bytes);
    /// The body is complete.
    Outcome complete(lws* connection);
    /// The time for the body, or for the answer, is over.
    std::optional<HttpResponse> expire(lws* connection);
    /// Answers that have come since the last call.
    std::vector<std::pair<lws*, HttpResponse>> finished();
    /// The server is stopping: finished() has a refusal for each, and so has what comes now.
    void say_goodbye() { stopping_ = true; }
    /// The connection is gone: nobody waits for its answer.
    void forget(lws* connection) { running_.erase(connection); }

  private:
    struct Running {
        RestMatch match;
        RestCall::Caller caller;
        std::string peer;  ///< whom its place counts for
        std::string traceparent;
        HttpMethod method = HttpMethod::get;
        double wait_s = 0.0;
        bool has_body = false;
        std::string body;
        std::optional<Outcome> refused;  ///< to be said once the body has been read
        std::unique_ptr<RestCall> call;  ///< once it is among the session's connections
    };

    Outcome examine(const RestHead& head, Running& running);
    std::optional<Outcome> examine_caller(const RestHead& head, Running& running,
                                          const std::string& name);
    void audit(const RestHead& head, const Running& running) const;
    Outcome start(lws* connection);
    HttpResponse answer_request(const Running& running);
    HttpResponse answer_photometry() const;
    std::optional<HttpResponse> refuse_crowd(const Running& asking) const;

    NetworkState& state_;
    bool stopping_ = false;
    std::map<lws*, Running> running_;
    RestRequests requests_;
};

}  // namespace raybundle
