// SPDX-License-Identifier: Apache-2.0
#include "net/http/http_transfer.h"

#include <libwebsockets.h>

#include <algorithm>
#include <array>
#include <vector>

namespace raybundle {
namespace {

constexpr std::size_t kHeaderBytes = 2048;
constexpr std::size_t kPieceBytes = 32768;

/// Bytes of a string as libwebsockets takes them.
const unsigned char* bytes_of(const char* text) {
    return reinterpret_cast<const unsigned char*>(text);
}

/// Of the answers to a handshake.
std::string reason_of(int status) {
    switch (status) {
        case 400:
            return "Bad Request";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 426:
            return "Upgrade Required";
        case 431:
            return "Request Header Fields Too Large";
        default:
            return "Refused";
    }
}

}  // namespace

bool HttpTransfer::add_headers(lws* connection, unsigned char** next, unsigned char* end) {
    const auto headers = headers_of(response_);
    return std::all_of(headers.begin(), headers.end(), [&](const auto& header) {
        const auto& [name, value] = header;
        return lws_add_http_header_by_name(connection, bytes_of(name.c_str()),
                                           bytes_of(value.data()), static_cast<int>(value.size()),
                                           next, end) == 0;
    });
}

bool HttpTransfer::begin(lws* connection) {
    std::array<unsigned char, LWS_PRE + kHeaderBytes> buffer{};
    unsigned char* const start = buffer.data() + LWS_PRE;
    unsigned char* const end = buffer.data() + buffer.size() - 1;
    unsigned char* next = start;
    const std::string type(response_.content_type);
    size_ = response_.send_body ? response_.content().size() : 0;
    return lws_add_http_common_headers(connection, static_cast<unsigned>(response_.status),
                                       type.c_str(), response_.content().size(), &next, end) == 0 &&
           add_headers(connection, &next, end) &&
           lws_finalize_write_http_header(connection, start, &next, end) == 0 &&
           (size_ == 0 || lws_callback_on_writable(connection) >= 0);
}

bool HttpTransfer::write(lws* connection) {
    const std::size_t size = std::min(size_ - written_, kPieceBytes);
    std::vector<unsigned char> piece(LWS_PRE + size);
    std::copy_n(response_.content().begin() + static_cast<std::ptrdiff_t>(written_), size,
                piece.begin() + LWS_PRE);
    const bool last = written_ + size == size_;
    const int count = lws_write(connection, piece.data() + LWS_PRE, size,
                                last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP);
    if (count < static_cast<int>(size)) {
        return false;
    }
    written_ += size;
    return last || lws_callback_on_writable(connection) >= 0;
}

void write_refusal(lws* connection, const HttpResponse& response) {
    std::string text(LWS_PRE, '\0');
    text += "HTTP/1.1 " + std::to_string(response.status) + " " + reason_of(response.status) +
            "\r\ncontent-type: " + std::string(response.content_type) +
            "\r\ncontent-length: " + std::to_string(response.content().size()) +
            "\r\nconnection: close\r\n";
    for (const auto& [name, value] : headers_of(response)) {
        text.append(name).append(" ").append(value).append("\r\n");
    }
    text += "\r\n" + response.content();
    lws_write(connection, reinterpret_cast<unsigned char*>(text.data()) + LWS_PRE,
              text.size() - LWS_PRE, LWS_WRITE_HTTP_HEADERS);
}

}  // namespace raybundle
