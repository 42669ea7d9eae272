// SPDX-License-Identifier: Apache-2.0
#include "telemetry/http_connection.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <system_error>

namespace raybundle {
namespace {

constexpr int slice_ms = 50;  ///< of a wait, after which the deadline is asked for again
constexpr std::size_t max_head_bytes = 65536;

std::string words_of(int error) {
    return std::generic_category().message(error);
}

/// A name that is being looked up: a thread of the C library writes into it.
struct Lookup {
    Lookup(std::string of, std::uint16_t at) : host(std::move(of)), port(std::to_string(at)) {
        hints.ai_family = AF_UNSPEC;
        hints.ai_socktype = SOCK_STREAM;
        request.ar_name = host.c_str();
        request.ar_service = port.c_str();
        request.ar_request = &hints;
    }
    ~Lookup() {
        if (request.ar_result != nullptr) {
            freeaddrinfo(request.ar_result);
        }
    }
    Lookup(const Lookup&) = delete;
    Lookup& operator=(const Lookup&) = delete;

    std::string host, port;
    addrinfo hints{};
    gaicb request{};
};

/// Null where it has no address, or no time: then what is being looked up stays behind.
std::unique_ptr<Lookup> look_up(const HttpUrl& url, const HttpConnection::Deadline& deadline) {
    auto lookup = std::make_unique<Lookup>(url.host, url.port);
    lookup->hints.ai_flags = AI_NUMERICHOST;
    if (getaddrinfo(lookup->host.c_str(), lookup->port.c_str(), &lookup->hints,
                    &lookup->request.ar_result) == 0) {
        return lookup;
    }
    lookup->hints.ai_flags = 0;
    std::array<gaicb*, 1> requests{&lookup->request};
    if (getaddrinfo_a(GAI_NOWAIT, requests.data(), 1, nullptr) != 0) {
        return nullptr;
    }
    while (gai_error(&lookup->request) == EAI_INPROGRESS) {
        if (HttpConnection::Clock::now() >= deadline()) {
            if (gai_cancel(&lookup->request) != EAI_CANCELED) {
                static_cast<void>(lookup.release());
            }
            return nullptr;
        }
        const std::array<const gaicb*, 1> waiting{&lookup->request};
        const timespec slice{0, 1'000'000L * slice_ms};
        gai_suspend(waiting.data(), 1, &slice);
    }
    return gai_error(&lookup->request) == 0 ? std::move(lookup) : nullptr;
}

}  // namespace

void HttpConnection::TlsDeleter::operator()(ssl_st* tls) const {
    SSL_free(tls);
}

HttpConnection::~HttpConnection() {
    session_.reset();
    if (socket_ >= 0) {
        close(socket_);
    }
}

bool HttpConnection::fail(std::string problem) {
    problem_ = std::move(problem);
    return false;
}

/// False where the time is over.
bool HttpConnection::wait(short events) {
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_() - Clock::now());
        if (left.count() <= 0) {
            return fail("no answer in time");
        }
        pollfd ready{socket_, events, 0};
        if (poll(&ready, 1, static_cast<int>(std::min<long>(left.count(), slice_ms))) > 0) {
            return true;
        }
    }
}

bool HttpConnection::connect_to(const addrinfo& address) {
    if (socket_ >= 0) {
        close(socket_);
    }
    socket_ = socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ < 0) {
        return fail(words_of(errno));
    }
    if (::connect(socket_, address.ai_addr, address.ai_addrlen) == 0) {
        return true;
    }
    if (errno != EINPROGRESS) {
        return fail(words_of(errno));
    }
    if (!wait(POLLOUT)) {
        return false;
    }
    int error = 0;
    socklen_t size = sizeof error;
    getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size);
    return error == 0 || fail(words_of(error));
}

bool HttpConnection::open(const HttpUrl& url) {
    const std::unique_ptr<Lookup> lookup = look_up(url, deadline_);
    if (lookup == nullptr) {
        return fail("no address of this name");
    }
    for (const addrinfo* address = lookup->request.ar_result; address != nullptr;
         address = address->ai_next) {
        if (connect_to(*address)) {
            return tls_ == nullptr || shake_hands(url.host);
        }
    }
    return false;
}

/// The certificate has to be of the host, a name or an address.
bool HttpConnection::shake_hands(const std::string& host) {
    session_.reset(SSL_new(tls_));
    std::array<unsigned char, sizeof(in6_addr)> numeric{};
    const bool address = inet_pton(AF_INET, host.c_str(), numeric.data()) == 1 ||
                         inet_pton(AF_INET6, host.c_str(), numeric.data()) == 1;
    X509_VERIFY_PARAM* const wanted = session_ ? SSL_get0_param(session_.get()) : nullptr;
    const bool ready = wanted != nullptr && SSL_set_fd(session_.get(), socket_) == 1 &&
                       (address ? X509_VERIFY_PARAM_set1_ip_asc(wanted, host.c_str()) == 1
                                : SSL_set1_host(session_.get(), host.c_str()) == 1 &&
                                      SSL_set_tlsext_host_name(session_.get(), host.c_str()) == 1);
    if (!ready) {
        return fail("TLS cannot be set up");
    }
    for (;;) {
        const int result = SSL_connect(session_.get());
        if (result == 1) {
            return true;
        }
        if (!wait_for_tls(result)) {
            const long verdict = SSL_get_verify_result(session_.get());
            return verdict == X509_V_OK ? false
                                        : fail(std::string("certificate: ") +
                                               X509_verify_cert_error_string(verdict));
        }
    }
}

/// Waits for what TLS has asked for. False: it has failed, or the time is over.
bool HttpConnection::wait_for_tls(int result) {
    const int reason = SSL_get_error(session_.get(), result);
    ERR_clear_error();
    if (reason == SSL_ERROR_WANT_READ || reason == SSL_ERROR_WANT_WRITE) {
        return wait(reason == SSL_ERROR_WANT_READ ? POLLIN : POLLOUT);
    }
    return fail("the connection was closed");
}

bool HttpConnection::write(std::string_view bytes) {
    while (!bytes.empty()) {
        long count = 0;
        if (session_) {
            const auto size = static_cast<int>(std::min<std::size_t>(bytes.size(), INT_MAX));
            count = SSL_write(session_.get(), bytes.data(), size);
            if (count <= 0 && !wait_for_tls(static_cast<int>(count))) {
                return false;
            }
        } else {
            count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (count < 0 && errno != EAGAIN && errno != EINTR) {
                return fail(words_of(errno));
            }
            if (count < 0 && !wait(POLLOUT)) {
                return false;
            }
        }
        bytes.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
    }
    return true;
}

/// Bytes that have come; 0: there will be none.
long HttpConnection::read_some(char* bytes, std::size_t size) {
    for (;;) {
        if (session_) {
            const int count = SSL_read(session_.get(), bytes, static_cast<int>(size));
            if (count > 0) {
                return count;
            }
            if (!wait_for_tls(count)) {
                return 0;
            }
            continue;
        }
        const long count = recv(socket_, bytes, size, 0);
        if (count > 0) {
            return count;
        }
        if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
            fail(count == 0 ? "the connection was closed" : words_of(errno));
            return 0;
        }
        if (!wait(POLLIN)) {
            return 0;
        }
    }
}

std::optional<std::string> HttpConnection::read_head() {
    constexpr std::string_view end = "\r\n\r\n";
    std::string head;
    std::array<char, 4096> bytes{};
    for (;;) {
        const long count = read_some(bytes.data(), bytes.size());
        if (count <= 0) {
            return std::nullopt;
        }
        head.append(bytes.data(), static_cast<std::size_t>(count));
        if (const std::size_t found = head.find(end); found != std::string::npos) {
            return head.substr(0, found + end.size());
        }
        if (head.size() > max_head_bytes) {
            fail("the answer is no HTTP");
            return std::nullopt;
        }
    }
}

}  // namespace raybundle
