// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "telemetry/http_url.h"

struct addrinfo;
struct ssl_ctx_st;
struct ssl_st;

namespace raybundle {

/// A connection to a server, with or without TLS, whose every wait ends at a deadline.
class HttpConnection {
  public:
    using Clock = std::chrono::steady_clock;
    using Deadline = std::function<Clock::time_point()>;

    /// tls: null where the address has none. Both must outlive it.
    HttpConnection(ssl_ctx_st* tls, const Deadline& deadline) : tls_(tls), deadline_(deadline) {}
    ~HttpConnection();
    HttpConnection(const HttpConnection&) = delete;
    HttpConnection& operator=(const HttpConnection&) = delete;

    /// Connects, to the first of the host's addresses that answers. False: see problem().
    bool open(const HttpUrl& url);
    bool write(std::string_view bytes);
    /// Up to and with the empty line behind the headers of an answer.
    std::optional<std::string> read_head();

    [[nodiscard]] const std::string& problem() const { return problem_; }

  private:
    struct TlsDeleter {
        void operator()(ssl_st* tls) const;
    };
    bool connect_to(const addrinfo& address);
    bool shake_hands(const std::string& host);
    bool wait(short events);
    bool wait_for_tls(int result);
    long read_some(char* bytes, std::size_t size);
    bool fail(std::string problem);

    ssl_ctx_st* tls_;
    const Deadline& deadline_;
    int socket_ = -1;
    std::unique_ptr<ssl_st, TlsDeleter> session_;
    std::string problem_;
};

}  // namespace raybundle
