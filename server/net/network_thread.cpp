// SPDX-License-Identifier: Apache-2.0
#include "net/network_thread.h"

#include <libwebsockets.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdint>
#include <exception>
#include <string_view>

#include "net/access/peer_name.h"
#include "net/http/http_request.h"
#include "net/network_context.h"

namespace raybundle {
namespace {

bool is_viewer_event(int reason) {
    return reason == LWS_CALLBACK_RECEIVE || reason == LWS_CALLBACK_RECEIVE_PONG ||
           reason == LWS_CALLBACK_SERVER_WRITEABLE || reason == LWS_CALLBACK_TIMER;
}

/// Entry from C: no exception may pass.
int lws_event(lws* connection, lws_callback_reasons reason, void* user, void* in,
              std::size_t size) {
    auto* const network =
        static_cast<NetworkThread*>(lws_context_user(lws_get_context(connection)));
    if (network == nullptr) {
        return 0;  // while the context is being made or destroyed
    }
    try {
        const bool about_tls = reason == LWS_CALLBACK_OPENSSL_LOAD_EXTRA_SERVER_VERIFY_CERTS;
        return network->on_event(connection, reason, about_tls ? user : in, size);
    } catch (const std::exception& error) {
        spdlog::error("a connection was closed after an internal error: {}", error.what());
        return -1;
    }
}

}  // namespace

void NetworkThread::start() {
    const NetworkContext created = create_network_context(state_.settings, &lws_event, this);
    {
        const std::lock_guard lock(context_mutex_);
        context_ = created.context;
    }
    port_ = created.port;
    thread_ = std::thread([this] { run(); });
}

void NetworkThread::stop() {
    stopping_ = true;
    wake();
    if (thread_.joinable()) {
        thread_.join();
    }
}

void NetworkThread::wake() {
    const std::lock_guard lock(context_mutex_);
    if (context_ != nullptr) {
        lws_cancel_service(context_);
    }
}

/// Serves until stopped, then lets the goodbyes go out for at most a moment.
void NetworkThread::run() {
    using Clock = std::chrono::steady_clock;
    constexpr auto kGoodbye = std::chrono::milliseconds(300);
    constexpr auto kGoodbyeStep = std::chrono::milliseconds(2);
    Clock::time_point end = Clock::time_point::max();
    while (Clock::now() < end && !(said_goodbye_ && viewers_.empty() && !http_.answering())) {
        if (said_goodbye_) {
            std::this_thread::sleep_for(kGoodbyeStep);
        }
        if (lws_service(context_, said_goodbye_ ? -1 : 0) < 0) {
            spdlog::error("the network service has failed");
            break;
        }
        mask_check_.between_rounds();
        if (stopping_ && !said_goodbye_) {
            said_goodbye_ = true;
            end = Clock::now() + kGoodbye;
            for (const auto& [connection, viewer] : viewers_) {
                viewer->close(CloseCode::going_away, "the server is stopping");
            }
            http_.say_goodbye();
        }
    }
    const std::lock_guard lock(context_mutex_);
    lws_context_destroy(context_);
    context_ = nullptr;
}

/// Closes a viewer's connection that breaks RFC 6455.
void NetworkThread::refuse_frames(lws* connection, std::string_view reason) {
    const auto viewer = viewers_.find(connection);
    if (viewer != viewers_.end()) {
        spdlog::warn("closed a connection of {}: {}", viewer->second->peer(), reason);
        viewer->second->close(CloseCode::protocol_error, reason);
    }
}

void NetworkThread::recheck_passes() {
    recheck_passes_ = true;
    wake();
}

void NetworkThread::use_certificate(std::shared_ptr<const TlsCertificate> certificate) {
    {
        const std::lock_guard lock(certificate_mutex_);
        certificate_ = std::move(certificate);
    }
    wake();
}

void NetworkThread::install_certificate() {
    std::shared_ptr<const TlsCertificate> certificate;
    {
        const std::lock_guard lock(certificate_mutex_);
        certificate = std::move(certificate_);
        certificate_.reset();
    }
    if (certificate && tls_ != nullptr && !certificate->install(tls_)) {
        spdlog::error("the new certificate was refused; the old one stays in use");
    }
}

void NetworkThread::on_woken() {
    install_certificate();
    http_.answer_uploads();
    const bool recheck = recheck_passes_.exchange(false);
    for (const auto& [connection, viewer] : viewers_) {
        viewer->next_slice();
        if (recheck) {
            viewer->check_pass();
        } else {
            viewer->poll_output();
        }
    }
}

/// Whether a connection may come in at all: a limit on all, and one on those of an address.
bool NetworkThread::accepts(int socket) {
    const ServerSettings& settings = state_.settings;
    const PeerAddress peer = peer_address(socket);
    const bool limited = settings.limit_loopback || !peer.loopback;
    const bool fits = connections_.size() < settings.max_connections &&
                      !(limited && addresses_.of(peer.key) >= settings.max_connections_per_address);
    state_.counters.connections_refused += fits ? 0 : 1;
    return fits;
}

void NetworkThread::add_connection(lws* connection) {
    std::string key = peer_address(lws_get_socket_fd(connection)).key;
    addresses_.add(key);
    connections_.emplace(connection, std::move(key));
}

void NetworkThread::remove_connection(lws* connection) {
    http_.forget(connection);
    mask_check_.forget(connection);
    viewers_.erase(connection);
    const auto found = connections_.find(connection);
    if (found != connections_.end()) {
        addresses_.remove(found->second);
        connections_.erase(found);
    }
}

/// Connections coming and going.
int NetworkThread::on_network_event(lws* connection, int reason, void* in) {
    switch (reason) {
        case LWS_CALLBACK_OPENSSL_LOAD_EXTRA_SERVER_VERIFY_CERTS:
            tls_ = static_cast<ssl_ctx_st*>(in);
            require_modern_tls(tls_);
            return 0;
        case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
            on_woken();
            return 0;
        case LWS_CALLBACK_FILTER_NETWORK_CONNECTION:
            return accepts(static_cast<int>(reinterpret_cast<std::intptr_t>(in))) ? 0 : 1;
        case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
            add_connection(connection);
            return 0;
        case LWS_CALLBACK_WSI_DESTROY:
            remove_connection(connection);
            return 0;
        default:
            return 0;
    }
}

int NetworkThread::on_event(lws* connection, int reason, void* in, std::size_t size) {
    if (HttpService::is_event(reason)) {
        return http_.on_event(connection, reason, in, size);
    }
    switch (reason) {
        case LWS_CALLBACK_ESTABLISHED:
            viewers_[connection] = std::make_unique<ViewerConnection>(
                connection, state_, request_peer(connection, state_.settings.trusted_proxies));
            mask_check_.add(connection);
            return 0;
        case LWS_CALLBACK_RAW_RX_FILE:
            return mask_check_.on_watch(connection) ? 0 : -1;
        case LWS_CALLBACK_RECEIVE:
            mask_check_.on_receive(connection);
            break;
        case LWS_CALLBACK_CLOSED:
            mask_check_.forget(connection);
            viewers_.erase(connection);
            return 0;
        default:
            break;
    }
    const auto viewer = viewers_.find(connection);
    if (viewer != viewers_.end() && is_viewer_event(reason)) {
        return on_viewer_event(*viewer->second, reason, in, size);
    }
    return reason == LWS_CALLBACK_TIMER ? http_.on_timer(connection)
                                        : on_network_event(connection, reason, in);
}

int NetworkThread::on_viewer_event(ViewerConnection& viewer, int reason, void* in,
                                   std::size_t size) {
    switch (reason) {
        case LWS_CALLBACK_RECEIVE:
            viewer.on_receive({static_cast<const char*>(in), size});
            return 0;
        case LWS_CALLBACK_RECEIVE_PONG:
            viewer.on_pong({static_cast<const char*>(in), size});
            return 0;
        case LWS_CALLBACK_SERVER_WRITEABLE:
            return viewer.on_writable() ? 0 : -1;
        case LWS_CALLBACK_TIMER:
            return viewer.on_timer() ? 0 : -1;
        default:
            return 0;
    }
}

}  // namespace raybundle
