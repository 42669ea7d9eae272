// SPDX-License-Identifier: Apache-2.0
#include "http_receiver.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <stdexcept>

namespace raybundle {
namespace {

std::size_t length_in(const std::string& head) {
    const std::string name = "Content-Length: ";
    const std::size_t found = head.find(name);
    return found == std::string::npos ? 0 : std::stoul(head.substr(found + name.size()));
}

}  // namespace

HttpReceiver::HttpReceiver(const std::string& certificate, const std::string& key) {
    std::signal(SIGPIPE, SIG_IGN);
    if (!certificate.empty()) {
        tls_ = SSL_CTX_new(TLS_server_method());
        SSL_CTX_use_certificate_chain_file(tls_, certificate.c_str());
        SSL_CTX_use_PrivateKey_file(tls_, key.c_str(), SSL_FILETYPE_PEM);
    }
    listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const generic = reinterpret_cast<sockaddr*>(&address);
    if (bind(listener_, generic, size) != 0 || listen(listener_, 16) != 0 ||
        getsockname(listener_, generic, &size) != 0) {
        throw std::runtime_error("the receiver cannot listen");
    }
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
}

HttpReceiver::~HttpReceiver() {
    stopping_ = true;
    thread_.join();
    close(listener_);
    for (const int socket : hanging_) {
        close(socket);
    }
    SSL_CTX_free(tls_);
}

std::string HttpReceiver::url() const {
    return (tls_ == nullptr ? "http" : "https") + std::string("://127.0.0.1:") +
           std::to_string(port_);
}

void HttpReceiver::answer(std::vector<int> statuses) {
    const std::lock_guard lock(mutex_);
    statuses_ = std::move(statuses);
}

int HttpReceiver::next_status() {
    const std::lock_guard lock(mutex_);
    if (statuses_.empty()) {
        return 200;
    }
    const int status = statuses_.front();
    statuses_.erase(statuses_.begin());
    return status;
}

std::vector<HttpReceiver::Request> HttpReceiver::wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(30), [&] { return requests_.size() >= count; });
    return requests_;
}

void HttpReceiver::serve() {
    while (!stopping_) {
        pollfd ready{listener_, POLLIN, 0};
        if (poll(&ready, 1, 10) <= 0) {
            continue;
        }
        const int socket = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
        if (socket < 0) {
            continue;
        }
        if (hangs_) {
            hanging_.push_back(socket);
        } else {
            take(socket);
            close(socket);
        }
    }
}

void HttpReceiver::take(int socket) {
    const timeval patience{10, 0};
    setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ssl_st* const session = tls_ == nullptr ? nullptr : SSL_new(tls_);
    bool open = true;
    if (session != nullptr) {
        SSL_set_fd(session, socket);
        open = SSL_accept(session) == 1;
    }
    std::string text;
    std::size_t end = std::string::npos;
    std::array<char, 4096> bytes{};
    while (open && (end == std::string::npos ||
                    text.size() < end + 4 + length_in(text.substr(0, end + 4)))) {
        const long count = session != nullptr
                               ? SSL_read(session, bytes.data(), static_cast<int>(bytes.size()))
                               : recv(socket, bytes.data(), bytes.size(), 0);
        open = count > 0;
        text.append(bytes.data(), open ? static_cast<std::size_t>(count) : 0);
        end = text.find("\r\n\r\n");
    }
    if (open) {
        const std::string answer = "HTTP/1.1 " + std::to_string(next_status()) +
                                   " Whatever\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
        session != nullptr ? SSL_write(session, answer.data(), static_cast<int>(answer.size()))
                           : send(socket, answer.data(), answer.size(), MSG_NOSIGNAL);
        {
            const std::lock_guard lock(mutex_);
            requests_.push_back({text.substr(0, end + 4), text.substr(end + 4)});
        }
        changed_.notify_all();
    }
    SSL_free(session);
}

}  // namespace raybundle
