// SPDX-License-Identifier: Apache-2.0
#include "net/http_transfer.h"

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

}  // namespace

bool HttpTransfer::begin(lws* connection) {
    std::array<unsigned char, LWS_PRE + kHeaderBytes> buffer{};
    unsigned char* const start = buffer.data() + LWS_PRE;
    unsigned char* const end = buffer.data() + buffer.size() - 1;
    unsigned char* next = start;
    const std::string type(response_.content_type);
    size_ = response_.send_body ? response_.content().size() : 0;
    if (lws_add_http_common_headers(connection, static_cast<unsigned>(response_.status),
                                    type.c_str(), response_.content().size(), &next, end) != 0) {
        return false;
    }
    for (const auto& [name, value] : http_headers()) {
        if (lws_add_http_header_by_name(connection, bytes_of(name), bytes_of(value.data()),
                                        static_cast<int>(value.size()), &next, end) != 0) {
            return false;
        }
    }
    if (response_.status == HTTP_STATUS_UNAUTHORIZED) {
        constexpr std::string_view kScheme = "Bearer";
        if (lws_add_http_header_by_token(connection, WSI_TOKEN_HTTP_WWW_AUTHENTICATE,
                                         bytes_of(kScheme.data()), static_cast<int>(kScheme.size()),
                                         &next, end) != 0) {
            return false;
        }
    }
    if (lws_finalize_write_http_header(connection, start, &next, end) != 0) {
        return false;
    }
    return size_ == 0 || lws_callback_on_writable(connection) >= 0;
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

}  // namespace raybundle
