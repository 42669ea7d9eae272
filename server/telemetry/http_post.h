// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "telemetry/http_url.h"

namespace raybundle {

/// What has become of a POST.
struct PostResult {
    int status = 0;       ///< 0: there was no answer
    std::string problem;  ///< why not
};

/// Sends bodies to one address by libcurl, each over a connection of its own. One thread at a time;
/// it waits for the network, and must not be told signals of broken pipes.
class HttpPost {
  public:
    using Clock = std::chrono::steady_clock;
    /// When to give up; asked again and again, so that it may come sooner than first thought.
    using Deadline = std::function<Clock::time_point()>;
    using Headers = std::vector<std::pair<std::string, std::string>>;

    /// ca_file: PEM file of who signs certificates; empty: those that the system trusts. Throws
    /// std::runtime_error where it cannot be read.
    HttpPost(HttpUrl url, Headers headers, std::string ca_file);

    [[nodiscard]] PostResult send(std::string_view content_type, std::string_view body,
                                  const Deadline& deadline) const;

  private:
    HttpUrl url_;
    Headers headers_;
    std::string ca_file_;
};

}  // namespace raybundle
