// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace raybundle {

/// Where something is sent over HTTP.
struct HttpUrl {
    bool tls = false;
    std::string host;  ///< name or numeric address, IPv6 without brackets
    std::uint16_t port = 80;
    std::string path = "/";

    /// As in a header: with the port unless it is the usual one, with brackets around IPv6.
    [[nodiscard]] std::string authority() const;
    [[nodiscard]] std::string text() const;
};

/// "http://127.0.0.1:4318" or "https://HOST/PATH". Nothing for another text, for one with a user
/// and password among them: who lists processes would read them.
std::optional<HttpUrl> parse_http_url(std::string_view text);

}  // namespace raybundle
