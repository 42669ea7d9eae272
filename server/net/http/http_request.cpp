// SPDX-License-Identifier: Apache-2.0
#include "net/http/http_request.h"

#include <algorithm>

#include "net/access/address_count.h"
#include "net/access/peer_name.h"
#include "net/network_context.h"

namespace raybundle {
namespace {

HttpMethod method_of(int method) {
    switch (method) {
        case LWSHUMETH_GET:
            return HttpMethod::get;
        case LWSHUMETH_HEAD:
            return HttpMethod::head;
        case LWSHUMETH_PUT:
            return HttpMethod::put;
        case LWSHUMETH_POST:
            return HttpMethod::post;
        case LWSHUMETH_PATCH:
            return HttpMethod::patch;
        case LWSHUMETH_DELETE:
            return HttpMethod::remove;
        default:
            return HttpMethod::other;
    }
}

}  // namespace

RequestLine request_line(lws* connection) {
    char* uri = nullptr;
    int length = 0;
    const HttpMethod method = method_of(lws_http_get_uri_and_method(connection, &uri, &length));
    return {method, std::string(uri, length > 0 ? static_cast<std::size_t>(length) : 0)};
}

std::string request_query(lws* connection) {
    constexpr int most_parts = 16;
    constexpr int most_bytes = 256;
    std::string query;
    for (int i = 0; i < most_parts; ++i) {
        std::string part(most_bytes, '\0');
        const int length =
            lws_hdr_copy_fragment(connection, part.data(), most_bytes, WSI_TOKEN_HTTP_URI_ARGS, i);
        if (length <= 0) {
            break;
        }
        query += (query.empty() ? "" : "&") + part.substr(0, static_cast<std::size_t>(length));
    }
    return query;
}

std::string request_header(lws* connection, int token) {
    const auto index = static_cast<lws_token_indexes>(token);
    std::string text(static_cast<std::size_t>(lws_hdr_total_length(connection, index)) + 1, '\0');
    const int length = lws_hdr_copy(connection, text.data(), static_cast<int>(text.size()), index);
    text.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    return text;
}

std::string custom_header(lws* connection, std::string_view name) {
    const int letters = static_cast<int>(name.size());
    const int size = lws_hdr_custom_length(connection, name.data(), letters);
    std::string text(static_cast<std::size_t>(std::max(size, 0)) + 1, '\0');
    const int length = lws_hdr_custom_copy(connection, text.data(), static_cast<int>(text.size()),
                                           name.data(), letters);
    text.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
    return text;
}

bool has_large_headers(lws* connection) {
    std::size_t bytes = 0;
    for (int token = 0; token < WSI_TOKEN_COUNT; ++token) {
        const int length = lws_hdr_total_length(connection, static_cast<lws_token_indexes>(token));
        bytes += static_cast<std::size_t>(std::max(length, 0));
    }
    return bytes > kMaxHeaderBytes;
}

std::string request_peer(lws* connection, const std::vector<std::string>& trusted_proxies) {
    return peer_name(peer_address(lws_get_socket_fd(connection)).text,
                     request_header(connection, WSI_TOKEN_X_FORWARDED_FOR), trusted_proxies);
}

HttpResponse large_headers_response() {
    HttpResponse response;
    response.status = 431;
    response.body =
        "The request's headers have more than " + std::to_string(kMaxHeaderBytes) + " bytes\n";
    return response;
}

}  // namespace raybundle
