// SPDX-License-Identifier: Apache-2.0
#include "net/http/http_service.h"

#include <libwebsockets.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "net/clock.h"
#include "net/http/http_request.h"
#include "net/ws/upgrade_check.h"

namespace raybundle {
namespace {

/// libwebsockets takes all that follows for the body then, further requests, too.
bool has_body_without_end(lws* connection, HttpMethod method) {
    const bool brings =
        method == HttpMethod::post || method == HttpMethod::put || method == HttpMethod::patch;
    return !request_header(connection, WSI_TOKEN_HTTP_TRANSFER_ENCODING).empty() ||
           (brings && !parse_length(request_header(connection, WSI_TOKEN_HTTP_CONTENT_LENGTH)));
}

/// Files that are of the project, not of the page.
bool is_kept(std::string_view path) {
    return path.starts_with(SnapshotStore::kFolder) || path == "/photometry";
}

/// Who knows a snapshot's whole path may fetch it.
std::string without_secret(std::string_view path) {
    constexpr std::size_t shown = 8;  // of 64 digits
    const std::size_t dot = path.rfind('.');
    if (!path.starts_with(SnapshotStore::kFolder) || dot == std::string_view::npos) {
        return std::string(path);
    }
    return std::string(path.substr(0, SnapshotStore::kFolder.size() + shown)) + "..." +
           std::string(path.substr(dot));
}

}  // namespace

bool HttpService::is_event(int reason) {
    return reason == LWS_CALLBACK_HTTP || reason == LWS_CALLBACK_HTTP_BODY ||
           reason == LWS_CALLBACK_HTTP_BODY_COMPLETION || reason == LWS_CALLBACK_HTTP_WRITEABLE ||
           reason == LWS_CALLBACK_CLOSED_HTTP || reason == LWS_CALLBACK_HTTP_CONFIRM_UPGRADE;
}

int HttpService::on_event(lws* connection, int reason, void* in, std::size_t size) {
    switch (reason) {
        case LWS_CALLBACK_HTTP:
            return on_request(connection);
        case LWS_CALLBACK_HTTP_WRITEABLE:
            return on_writable(connection);
        case LWS_CALLBACK_HTTP_BODY:
            return on_body(connection, {static_cast<const char*>(in), size});
        case LWS_CALLBACK_HTTP_BODY_COMPLETION:
            return on_complete(connection);
        case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
            return confirm_upgrade(connection) ? 0 : -1;
        default:
            forget(connection);
            return 0;
    }
}

int HttpService::on_timer(lws* connection) {
    if (auto held = held_.extract(connection)) {
        return answer(connection, std::move(held.mapped()));
    }
    if (rest_.takes_body(connection)) {
        auto over = rest_.expire(connection);
        return over ? answer(connection, std::move(*over)) : 0;
    }
    auto late = documents_.takes_body(connection) ? documents_.expire(connection)
                                                  : uploads_.expire(connection);
    return late ? answer(connection, std::move(*late)) : 0;
}

void HttpService::forget(lws* connection) {
    uploads_.forget(connection);
    documents_.forget(connection);
    rest_.forget(connection);
    transfers_.erase(connection);
    held_.erase(connection);
    endless_.erase(connection);
}

/// Refuses with an HTTP answer where the handshake is not for us.
bool HttpService::confirm_upgrade(lws* connection) {
    const UpgradeRequest request{request_header(connection, WSI_TOKEN_GET_URI),
                                 request_header(connection, WSI_TOKEN_ORIGIN),
                                 request_header(connection, WSI_TOKEN_HOST),
                                 request_header(connection, WSI_TOKEN_VERSION),
                                 request_header(connection, WSI_TOKEN_KEY),
                                 request_header(connection, WSI_TOKEN_PROTOCOL)};
    auto refusal = has_large_headers(connection)
                       ? std::optional(large_headers_response())
                       : refuse_upgrade(request, state_.gate.access()->origins);
    if (!refusal) {
        return true;
    }
    ++state_.counters.connections_refused;
    audit_refusal(connection, {}, request.path,
                  "a WebSocket from " + (request.origin.empty() ? "nowhere" : request.origin) +
                      ": status " + std::to_string(refusal->status));
    spdlog::warn("refused a WebSocket connection of {} to {} from origin {}: {}",
                 peer_of(connection), request.path, request.origin, refusal->status);
    write_refusal(connection, *refusal);
    return false;
}

/// A wrong token is noted, as one in hello is.
HttpService::Caller HttpService::caller(lws* connection, std::string_view where) {
    const std::string token = request_header(connection, WSI_TOKEN_HTTP_AUTHORIZATION);
    const auto pass = state_.gate.pass_of(token);
    Caller result;
    if (pass) {
        result.role = pass->role;
        result.token = pass->token_name;
    }
    if (!result.role && !token.empty()) {
        result.delay_ms =
            state_.gate.note_wrong_token(peer_of(connection), where, server_time_ms());
    }
    return result;
}

void HttpService::audit_refusal(lws* connection, const Caller& client, std::string_view what,
                                std::string_view reason) {
    if (state_.settings.audit) {
        state_.settings.audit->refuse({"", client.role, client.token, peer_of(connection)}, what,
                                      reason);
    }
}

void HttpService::audit_transfer(lws* connection, const Caller& client, bool upload,
                                 std::string_view path) {
    if (state_.settings.audit) {
        state_.settings.audit->transfer({"", client.role, client.token, peer_of(connection)},
                                        upload, path);
    }
}

std::string HttpService::peer_of(lws* connection) const {
    return request_peer(connection, state_.settings.trusted_proxies);
}

int HttpService::on_request(lws* connection) {
    const auto [method, path] = request_line(connection);
    if (has_large_headers(connection)) {
        return answer(connection, large_headers_response());
    }
    if (has_body_without_end(connection, method)) {
        endless_.insert(connection);
    }
    if (path.starts_with(kRestFolder)) {
        return on_rest(connection, method, path);
    }
    if (is_document(path) && (method == HttpMethod::get || method == HttpMethod::put)) {
        return on_document(connection, method, path);
    }
    if (method == HttpMethod::put) {
        return on_upload(connection, path);
    }
    HttpContent content{client_files(), state_.ready, {}, true, &state_.snapshots};
    content.encoded = &encoded_files_;
    content.contents = &state_.contents;
    content.editable = state_.editable();
    content.accept_encoding = request_header(connection, WSI_TOKEN_HTTP_ACCEPT_ENCODING);
    content.if_none_match = request_header(connection, WSI_TOKEN_HTTP_IF_NONE_MATCH);
    Caller client;
    if (path == "/metrics") {
        client = caller(connection, path);
        content.metrics_allowed = client.role.has_value();
    }
    if (path == "/metrics" && content.metrics_allowed) {
        content.metrics = state_.metrics();
    }
    if (path == "/photometry") {
        client = caller(connection, path);
        content.known_caller = client.role.has_value();
        content.photometry = content.known_caller ? state_.photometry() : std::nullopt;
    }
    HttpResponse response = http_response(method, path, content);
    if (response.status == 401) {
        audit_refusal(connection, client, path, "needs a token");
    } else if (response.status == 200 && is_kept(path)) {
        audit_transfer(connection, client, false, without_secret(path));
    }
    return answer_in(client.delay_ms, connection, std::move(response));
}

/// Whoever may look may read; reviewers bring pins in.
int HttpService::on_document(lws* connection, HttpMethod method, const std::string& path) {
    const bool put = method == HttpMethod::put;
    const Caller client = caller(connection, path);
    const auto refuse = [&](int status, const std::string& text) {
        audit_refusal(connection, client, path, text);
        return answer_in(client.delay_ms, connection, text_response({status, text}));
    };
    if (put && path != "/pins.bcf") {
        return refuse(405, "Only GET and HEAD");
    }
    if (put && !origin_allowed(request_header(connection, WSI_TOKEN_ORIGIN),
                               request_header(connection, WSI_TOKEN_HOST),
                               state_.gate.access()->origins)) {
        return refuse(403, "A page of another origin may not upload");
    }
    if (!client.role) {
        return refuse(401, "Needs the header Authorization: Bearer TOKEN");
    }
    if (put && *client.role < v1::REVIEWER) {
        return refuse(403, "Needs the role REVIEWER");
    }
    auto refusal =
        documents_.begin(connection, {path, request_query(connection), put, {}},
                         parse_length(request_header(connection, WSI_TOKEN_HTTP_CONTENT_LENGTH)));
    if (refusal) {
        return answer(connection, std::move(*refusal));
    }
    audit_transfer(connection, client, put, path);
    return 0;
}

int HttpService::on_upload(lws* connection, const std::string& path) {
    const Caller client = caller(connection, path);
    const UploadRequest request{
        path, request_header(connection, WSI_TOKEN_ORIGIN),
        request_header(connection, WSI_TOKEN_HOST), client.role,
        parse_length(request_header(connection, WSI_TOKEN_HTTP_CONTENT_LENGTH))};
    auto refusal = uploads_.begin(connection, request);
    if (refusal) {
        audit_refusal(connection, client, path, "status " + std::to_string(refusal->status));
        return answer_in(client.delay_ms, connection, std::move(*refusal));
    }
    audit_transfer(connection, client, true, path);
    return 0;
}

int HttpService::on_rest(lws* connection, HttpMethod method, const std::string& path) {
    const std::string length = request_header(connection, WSI_TOKEN_HTTP_CONTENT_LENGTH);
    return go_on(connection,
                 rest_.begin(connection,
                             {method, path, request_query(connection),
                              request_header(connection, WSI_TOKEN_HTTP_AUTHORIZATION),
                              request_header(connection, WSI_TOKEN_HTTP_CONTENT_TYPE),
                              request_header(connection, WSI_TOKEN_ORIGIN),
                              request_header(connection, WSI_TOKEN_HOST), parse_length(length),
                              !request_header(connection, WSI_TOKEN_HTTP_TRANSFER_ENCODING).empty(),
                              peer_of(connection), custom_header(connection, "traceparent:")}));
}

/// Answers now or later, or waits for the rest of the request.
int HttpService::go_on(lws* connection, RestService::Outcome outcome) {
    if (outcome.response) {
        return answer_in(outcome.delay_ms, connection, std::move(*outcome.response));
    }
    lws_set_timer_usecs(connection, static_cast<lws_usec_t>(1e6 * outcome.time_s));
    return 0;
}

int HttpService::on_complete(lws* connection) {
    if (rest_.takes_body(connection)) {
        return go_on(connection, rest_.complete(connection));
    }
    documents_.takes_body(connection) ? documents_.complete(connection)
                                      : uploads_.complete(connection);
    return 0;
}

int HttpService::on_body(lws* connection, std::string_view bytes) {
    if (rest_.takes_body(connection)) {
        rest_.write(connection, bytes);
        return 0;
    }
    if (documents_.takes_body(connection)) {
        documents_.write(connection, bytes);
        return 0;
    }
    auto problem = uploads_.write(connection, bytes);
    return problem ? answer(connection, std::move(*problem)) : 0;
}

int HttpService::answer(lws* connection, HttpResponse response) {
    response.ends_connection |= endless_.erase(connection) > 0;
    auto& transfer = transfers_[connection];
    transfer = std::make_unique<HttpTransfer>(std::move(response));
    if (!transfer->begin(connection)) {
        return -1;
    }
    return transfer->done() ? end_transfer(connection) : 0;
}

/// Holds the answer back for a while.
int HttpService::answer_in(double delay_ms, lws* connection, HttpResponse response) {
    if (delay_ms <= 0.0) {
        return answer(connection, std::move(response));
    }
    constexpr double kMicrosecondsPerMs = 1000.0;
    held_.insert_or_assign(connection, std::move(response));
    lws_set_timer_usecs(connection, static_cast<lws_usec_t>(kMicrosecondsPerMs * delay_ms));
    return 0;
}

void HttpService::answer_uploads() {
    auto finished = uploads_.finished();
    for (auto& made : documents_.finished()) {
        finished.push_back(std::move(made));
    }
    for (auto& answered : rest_.finished()) {
        finished.push_back(std::move(answered));
    }
    for (auto& [connection, response] : finished) {
        if (answer(connection, std::move(response)) != 0) {
            lws_set_timeout(connection, PENDING_TIMEOUT_USER_REASON_BASE, LWS_TO_KILL_ASYNC);
        }
    }
}

void HttpService::say_goodbye() {
    documents_.say_goodbye();
    rest_.say_goodbye();
    answer_uploads();
}

int HttpService::on_writable(lws* connection) {
    const auto transfer = transfers_.find(connection);
    if (transfer == transfers_.end()) {
        return 0;
    }
    if (!transfer->second->write(connection)) {
        return -1;
    }
    return transfer->second->done() ? end_transfer(connection) : 0;
}

/// The connection stays open for the next request where the client wants that.
int HttpService::end_transfer(lws* connection) {
    const bool close = transfers_.at(connection)->ends_connection();
    transfers_.erase(connection);
    if (close) {
        return -1;
    }
    return lws_http_transaction_completed(connection) != 0 ? -1 : 0;
}

}  // namespace raybundle
