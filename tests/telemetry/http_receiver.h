// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

struct ssl_ctx_st;
struct ssl_st;

namespace raybundle {

/// Takes POSTs, one connection after the other, as a collector of OpenTelemetry does.
class HttpReceiver {
  public:
    struct Request {
        std::string head;  ///< with the empty line
        std::string body;
    };

    /// With TLS where files are named.
    explicit HttpReceiver(const std::string& certificate = {}, const std::string& key = {});
    ~HttpReceiver();
    HttpReceiver(const HttpReceiver&) = delete;
    HttpReceiver& operator=(const HttpReceiver&) = delete;

    [[nodiscard]] std::uint16_t port() const { return port_; }
    /// Base address for an exporter.
    [[nodiscard]] std::string url() const;

    /// Answers the next requests so, in this order, then 200.
    void answer(std::vector<int> statuses);
    /// Takes connections from now on and never answers.
    void hang() { hangs_ = true; }

    /// Waits until so many requests have come, half a minute at most; all that have.
    std::vector<Request> wait_for(std::size_t count);

  private:
    void serve();
    void take(int socket);
    int next_status();

    int listener_ = -1;
    std::uint16_t port_ = 0;
    ssl_ctx_st* tls_ = nullptr;
    std::atomic<bool> stopping_{false}, hangs_{false};
    std::vector<int> hanging_;  ///< connections that get no answer; its thread only
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Request> requests_;
    std::vector<int> statuses_;
    std::thread thread_;
};

}  // namespace raybundle
