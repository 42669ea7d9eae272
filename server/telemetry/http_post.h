// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "telemetry/http_url.h"

struct ssl_ctx_st;

namespace raybundle {

/// What has become of a POST.
struct PostResult {
    int status = 0;       ///< 0: there was no answer
    std::string problem;  ///< why not
};

/// Sends bodies to one address, each over a connection of its own. One thread at a time; it waits
/// for the network, and must not be told signals of broken pipes.
class HttpPost {
  public:
    using Clock = std::chrono::steady_clock;
    /// When to give up; asked again and again, so that it may come sooner than first thought.
    using Deadline = std::function<Clock::time_point()>;
    using Headers = std::vector<std::pair<std::string, std::string>>;

    /// ca_file: PEM file of who signs certificates; empty: those that the system trusts. Throws
    /// std::runtime_error where it cannot be read.
    HttpPost(HttpUrl url, Headers headers, const std::string& ca_file);
    ~HttpPost();
    HttpPost(const HttpPost&) = delete;
    HttpPost& operator=(const HttpPost&) = delete;

    [[nodiscard]] PostResult send(std::string_view content_type, std::string_view body,
                                  const Deadline& deadline) const;

    [[nodiscard]] const HttpUrl& url() const { return url_; }

  private:
    struct ContextDeleter {
        void operator()(ssl_ctx_st* context) const;
    };

    HttpUrl url_;
    Headers headers_;
    std::unique_ptr<ssl_ctx_st, ContextDeleter> tls_;
};

}  // namespace raybundle
