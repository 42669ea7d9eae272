// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "net/http/http_response.h"

struct lws;

namespace raybundle {

/// One HTTP answer on its way to a libwebsockets connection. Network thread only.
class HttpTransfer {
  public:
    explicit HttpTransfer(HttpResponse response) : response_(std::move(response)) {}

    /// Writes the headers and asks to be told when the body may follow. False: close the
    /// connection.
    bool begin(lws* connection);

    /// Writes the next piece of the body. False: close the connection.
    bool write(lws* connection);

    /// The whole answer has been written.
    [[nodiscard]] bool done() const { return written_ == size_; }
    [[nodiscard]] bool ends_connection() const { return response_.ends_connection; }

  private:
    bool add_headers(lws* connection, unsigned char** next, unsigned char* end);

    HttpResponse response_;
    std::size_t size_ = 0;  ///< bytes of the body that are to be written
    std::size_t written_ = 0;
};

/// Writes a short answer whole, in HTTP/1.1, where libwebsockets does not know the request's
/// version yet: to a WebSocket handshake that is refused. Close the connection then.
void write_refusal(lws* connection, const HttpResponse& response);

}  // namespace raybundle
