// SPDX-License-Identifier: Apache-2.0
#include "telemetry/http_post.h"

#include <openssl/err.h>
#include <openssl/ssl.h>

#include <charconv>
#include <optional>
#include <stdexcept>

#include "telemetry/http_connection.h"

namespace raybundle {
namespace {

/// Of "HTTP/1.1 200 OK"; 0 where it is no such line.
int status_of(std::string_view head) {
    constexpr std::size_t place = 9;  // of the number
    int status = 0;
    if (head.starts_with("HTTP/1.") && head.size() > place + 3) {
        std::from_chars(head.data() + place, head.data() + place + 3, status);
    }
    return status;
}

}  // namespace

void HttpPost::ContextDeleter::operator()(ssl_ctx_st* context) const {
    SSL_CTX_free(context);
}

HttpPost::HttpPost(HttpUrl url, Headers headers, const std::string& ca_file)
    : url_(std::move(url)), headers_(std::move(headers)) {
    if (!url_.tls) {
        return;
    }
    tls_.reset(SSL_CTX_new(TLS_client_method()));
    const bool trusting =
        tls_ != nullptr && SSL_CTX_set_min_proto_version(tls_.get(), TLS1_2_VERSION) == 1 &&
        (ca_file.empty()
             ? SSL_CTX_set_default_verify_paths(tls_.get()) == 1
             : SSL_CTX_load_verify_locations(tls_.get(), ca_file.c_str(), nullptr) == 1);
    ERR_clear_error();
    if (!trusting) {
        throw std::runtime_error(ca_file.empty() ? "TLS cannot be set up"
                                                 : ca_file + ": holds no PEM certificates");
    }
    SSL_CTX_set_verify(tls_.get(), SSL_VERIFY_PEER, nullptr);
}

HttpPost::~HttpPost() = default;

PostResult HttpPost::send(std::string_view content_type, std::string_view body,
                          const Deadline& deadline) const {
    std::string head =
        "POST " + url_.path + " HTTP/1.1\r\nHost: " + url_.authority() +
        "\r\nUser-Agent: raybundle/" RAYBUNDLE_VERSION "\r\nConnection: close\r\nContent-Type: " +
        std::string(content_type) + "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n";
    for (const auto& [name, value] : headers_) {
        head += name + ": " + value + "\r\n";
    }
    HttpConnection connection(tls_.get(), deadline);
    if (!connection.open(url_) || !connection.write(head + "\r\n") || !connection.write(body)) {
        return {0, connection.problem()};
    }
    const std::optional<std::string> answer = connection.read_head();
    const int status = answer ? status_of(*answer) : 0;
    return {status, status > 0 ? "" : answer ? "the answer is no HTTP" : connection.problem()};
}

}  // namespace raybundle
