// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "net/access/address_count.h"
#include "net/access/tls_certificate.h"
#include "net/http/http_service.h"
#include "net/network_state.h"
#include "net/ws/mask_check.h"
#include "net/ws/viewer_connection.h"

struct lws;
struct lws_context;
struct ssl_ctx_st;

namespace raybundle {

/// Owns the libwebsockets context and the only thread that touches it.
class NetworkThread {
  public:
    explicit NetworkThread(NetworkState& state) : state_(state), http_(state, [this] { wake(); }) {}
    ~NetworkThread() { stop(); }
    NetworkThread(const NetworkThread&) = delete;
    NetworkThread& operator=(const NetworkThread&) = delete;

    void start();  ///< throws std::runtime_error that names the address
    void stop();

    [[nodiscard]] std::uint16_t port() const { return port_; }

    /// Any thread: there is something to write.
    void wake();

    /// Any thread: viewers whose token is no longer accepted are to be closed.
    void recheck_passes();

    /// Any thread: new connections use this certificate.
    void use_certificate(std::shared_ptr<const TlsCertificate> certificate);

    /// Called by libwebsockets with an lws_callback_reasons; the result is what it expects.
    int on_event(lws* connection, int reason, void* in, std::size_t size);

  private:
    void run();
    void on_woken();
    void install_certificate();
    int on_network_event(lws* connection, int reason, void* in);
    [[nodiscard]] bool accepts(int socket);
    void add_connection(lws* connection);
    void remove_connection(lws* connection);
    int on_viewer_event(ViewerConnection& viewer, int reason, void* in, std::size_t size);
    void refuse_frames(lws* connection, std::string_view reason);

    NetworkState& state_;
    std::thread thread_;
    std::mutex context_mutex_;  ///< guards context_ against wake() while it is destroyed
    lws_context* context_ = nullptr;
    std::atomic<std::uint16_t> port_{0};
    std::atomic<bool> stopping_{false};

    std::atomic<bool> recheck_passes_{false};
    std::mutex certificate_mutex_;
    std::shared_ptr<const TlsCertificate> certificate_;  ///< to be installed

    // Network thread only, once it runs.
    ssl_ctx_st* tls_ = nullptr;
    std::map<lws*, std::string> connections_;  ///< and the address each one counts for
    AddressCount addresses_;
    std::map<lws*, std::unique_ptr<ViewerConnection>> viewers_;
    HttpService http_;
    MaskCheck mask_check_{
        [this](lws* connection, std::string_view reason) { refuse_frames(connection, reason); }};
    bool said_goodbye_ = false;
};

}  // namespace raybundle
