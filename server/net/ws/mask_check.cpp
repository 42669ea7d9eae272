// SPDX-License-Identifier: Apache-2.0
#include "net/ws/mask_check.h"

#include <fcntl.h>
#include <libwebsockets.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <utility>

namespace raybundle {
namespace {

/// What says whether a frame is masked (RFC 6455, 5.2).
using FrameStart = std::array<unsigned char, 2>;

constexpr unsigned kMaskBit = 0x80;

/// The socket counts as readable at so many bytes, or at its end.
void set_readable_at(int socket, int bytes) {
    setsockopt(socket, SOL_SOCKET, SO_RCVLOWAT, &bytes, sizeof bytes);
}

struct Peeked {
    bool waits = false;  ///< for more to come
    int bytes = 0;       ///< fewer than 2: at the end, or of a TLS record
};

/// Whether the client sends no more.
bool has_ended(int socket) {
    pollfd state{socket, POLLRDHUP, 0};
    return poll(&state, 1, 0) > 0;
}

Peeked peek_socket(int socket, FrameStart& start) {
    const auto count = recv(socket, start.data(), start.size(), MSG_PEEK | MSG_DONTWAIT);
    if (count < 0) {
        return {errno == EAGAIN || errno == EINTR, 0};
    }
    const bool part = count > 0 && static_cast<std::size_t>(count) < start.size();
    return {part && !has_ended(socket), static_cast<int>(count)};
}

Peeked peek_tls(SSL* tls, FrameStart& start) {
    ERR_clear_error();
    const int count = SSL_peek(tls, start.data(), static_cast<int>(start.size()));
    return {count <= 0 && SSL_get_error(tls, count) == SSL_ERROR_WANT_READ, count};
}

}  // namespace

/// `masked` also where there is nothing to object to: a connection that ends.
MaskCheck::Verdict MaskCheck::peek(lws* connection) {
    FrameStart start{};
    SSL* const tls = lws_get_ssl(connection);
    const Peeked peeked =
        tls != nullptr ? peek_tls(tls, start) : peek_socket(lws_get_socket_fd(connection), start);
    if (peeked.waits) {
        return Verdict::unknown;
    }
    const bool whole = peeked.bytes == static_cast<int>(start.size());
    return whole && (start[1] & kMaskBit) == 0 ? Verdict::unmasked : Verdict::masked;
}

void MaskCheck::on_receive(lws* connection) {
    if (new_.erase(connection) > 0) {
        refuse_(connection, "a frame came before the answer to the handshake");
    }
}

bool MaskCheck::on_watch(lws* watch) {
    lws* const connection = lws_get_parent(watch);
    if (!watched_.contains(connection) || peek(connection) != Verdict::unknown) {
        decided_.insert(connection);
        return false;
    }
    return true;
}

void MaskCheck::between_rounds() {
    for (lws* const connection : std::exchange(new_, {})) {
        begin(connection);
    }
    for (lws* const connection : std::exchange(decided_, {})) {
        if (watched_.erase(connection) > 0) {
            let_go(connection, peek(connection));
        }
    }
}

void MaskCheck::begin(lws* connection) {
    lws_rx_flow_control(connection, 0);
    const int socket = lws_get_socket_fd(connection);
    set_readable_at(socket, static_cast<int>(FrameStart().size()));
    watched_.insert(connection);
    lws_sock_file_fd_type copy{};
    copy.filefd = fcntl(socket, F_DUPFD_CLOEXEC, 0);
    if (copy.filefd < 0) {
        refuse_(connection, "the server is out of descriptors");
        return;
    }
    if (lws_adopt_descriptor_vhost(lws_get_vhost(connection), LWS_ADOPT_RAW_FILE_DESC, copy,
                                   nullptr, connection) == nullptr) {
        close(copy.filefd);
        refuse_(connection, "the server is out of descriptors");
    } else if (peek(connection) != Verdict::unknown) {
        decided_.insert(connection);
    }
}

/// Lets libwebsockets read what is masked; it would answer an unmasked ping before it closes. Bytes
/// of TLS that were looked at have left the socket, which need not become readable again.
void MaskCheck::let_go(lws* connection, Verdict verdict) {
    if (verdict == Verdict::unmasked) {
        refuse_(connection, "frames of a client must be masked (RFC 6455, 5.1)");
        return;
    }
    const int socket = lws_get_socket_fd(connection);
    set_readable_at(socket, 1);
    lws_rx_flow_control(connection, 1);
    if (lws_get_ssl(connection) != nullptr) {
        lws_pollfd readable{socket, LWS_POLLIN, LWS_POLLIN};
        lws_service_fd(lws_get_context(connection), &readable);
    }
}

void MaskCheck::forget(lws* connection) {
    new_.erase(connection);
    watched_.erase(connection);
    decided_.erase(connection);
}

}  // namespace raybundle
