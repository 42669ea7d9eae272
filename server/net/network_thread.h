// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "net/http_transfer.h"
#include "net/network_state.h"
#include "net/viewer_connection.h"

struct lws;
struct lws_context;

namespace raybundle {

/// Owns the libwebsockets context and the only thread that touches it.
class NetworkThread {
  public:
    explicit NetworkThread(NetworkState& state) : state_(state) {}
    ~NetworkThread() { stop(); }
    NetworkThread(const NetworkThread&) = delete;
    NetworkThread& operator=(const NetworkThread&) = delete;

    void start();  ///< throws std::runtime_error that names the address
    void stop();

    [[nodiscard]] std::uint16_t port() const { return port_; }

    /// Any thread: there is something to write.
    void wake();

    /// Called by libwebsockets with an lws_callback_reasons; the result is what it expects.
    int on_event(lws* connection, int reason, void* in, std::size_t size);

  private:
    void run();
    void poll_all();
    bool confirm_upgrade(lws* connection);
    int on_http_request(lws* connection);
    int on_http_writable(lws* connection);
    int on_viewer_event(ViewerConnection& viewer, int reason, void* in, std::size_t size);
    void accept_viewer(lws* connection);
    int end_transfer(lws* connection);

    NetworkState& state_;
    std::thread thread_;
    std::mutex context_mutex_;  ///< guards context_ against wake() while it is destroyed
    lws_context* context_ = nullptr;
    std::atomic<std::uint16_t> port_{0};
    std::atomic<bool> stopping_{false};

    // Network thread only.
    std::set<lws*> connections_;
    std::map<lws*, std::unique_ptr<ViewerConnection>> viewers_;
    std::map<lws*, std::unique_ptr<HttpTransfer>> transfers_;
    bool said_goodbye_ = false;
};

}  // namespace raybundle
