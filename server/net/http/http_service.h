// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "embedded_file.h"
#include "net/http/encoded_files.h"
#include "net/http/http_documents.h"
#include "net/http/http_response.h"
#include "net/http/http_transfer.h"
#include "net/http/http_uploads.h"
#include "net/network_state.h"
#include "net/rest/rest_service.h"

struct lws;

namespace raybundle {

/// Answers HTTP requests: the page, health, metrics, snapshots, uploads; refuses WebSocket
/// handshakes that are not for us. Network thread only.
class HttpService {
  public:
    /// `wake` makes the network thread call answer_uploads(); any thread calls it.
    HttpService(NetworkState& state, std::function<void()> wake)
        : state_(state), uploads_(state, wake), documents_(state, std::move(wake)), rest_(state) {}

    /// Whether on_event() is to hear of an lws_callback_reasons.
    static bool is_event(int reason);

    /// The result is what libwebsockets expects: nonzero closes the connection.
    int on_event(lws* connection, int reason, void* in, std::size_t size);

    /// LWS_CALLBACK_TIMER of a connection that is no viewer's.
    int on_timer(lws* connection);

    /// Answers the uploads that have been checked and what has been asked below /api, and sends the
    /// documents that have been made.
    void answer_uploads();

    /// The server is stopping: answers all who wait, and whoever asks from now on, with 503.
    void say_goodbye();
    /// Answers are on their way.
    [[nodiscard]] bool answering() const { return !transfers_.empty(); }

    /// The connection is gone.
    void forget(lws* connection);

  private:
    int on_request(lws* connection);
    int on_body(lws* connection, std::string_view bytes);
    int on_document(lws* connection, HttpMethod method, const std::string& path);
    int on_upload(lws* connection, const std::string& path);
    int on_rest(lws* connection, HttpMethod method, const std::string& path);
    int go_on(lws* connection, RestService::Outcome outcome);
    int on_complete(lws* connection);
    int on_writable(lws* connection);
    bool confirm_upgrade(lws* connection);
    int answer(lws* connection, HttpResponse response);
    int answer_in(double delay_ms, lws* connection, HttpResponse response);
    int end_transfer(lws* connection);

    struct Caller {
        std::optional<v1::Role> role;  ///< none: a wrong token, or none
        std::string token;             ///< its name
        double delay_ms = 0.0;         ///< of the answer to a wrong token
    };
    Caller caller(lws* connection, std::string_view where);
    [[nodiscard]] std::string peer_of(lws* connection) const;
    void audit_refusal(lws* connection, const Caller& client, std::string_view what,
                       std::string_view reason);
    void audit_transfer(lws* connection, const Caller& client, bool upload, std::string_view path);

    NetworkState& state_;
    const EncodedFiles encoded_files_{client_files()};
    std::set<lws*> endless_;  ///< their request's body has no end that is known
    std::map<lws*, std::unique_ptr<HttpTransfer>> transfers_;
    std::map<lws*, HttpResponse> held_;  ///< until the connection's timer
    HttpUploads uploads_;
    HttpDocuments documents_;
    RestService rest_;
};

}  // namespace raybundle
