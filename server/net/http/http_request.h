// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "net/http/http_response.h"

struct lws;

namespace raybundle {

struct RequestLine {
    HttpMethod method = HttpMethod::other;
    std::string path;  ///< decoded, without query
};

/// What an HTTP request asks for.
RequestLine request_line(lws* connection);

/// What follows the question mark, decoded; its parts are joined by &.
std::string request_query(lws* connection);

/// Value of a header by its lws_token_indexes; empty where it is absent.
std::string request_header(lws* connection, int token);

/// Value of a header that libwebsockets does not know, by its name in lower case with the colon;
/// empty where it is absent.
std::string custom_header(lws* connection, std::string_view name);

/// Whether the headers that libwebsockets knows by name, the cookie among them, have more than
/// kMaxHeaderBytes.
bool has_large_headers(lws* connection);

/// Who sent a request, see peer_name().
std::string request_peer(lws* connection, const std::vector<std::string>& trusted_proxies);

/// 431, which says so.
HttpResponse large_headers_response();

}  // namespace raybundle
