// SPDX-License-Identifier: Apache-2.0
#include "net/access/listen_address.h"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace raybundle {
namespace {

using AddressList = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

AddressList look_up(const std::string& host, const std::string& port) {
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_PASSIVE;
    addrinfo* found = nullptr;
    const int error = getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
    if (error != 0) {
        throw std::runtime_error("cannot listen on " + host + ": " + gai_strerror(error));
    }
    return {found, &freeaddrinfo};
}

}  // namespace

ListenAddress resolve_listen_address(const std::string& host) {
    const AddressList found = look_up(host, "0");
    std::array<char, NI_MAXHOST> text{};
    const int error = getnameinfo(found->ai_addr, found->ai_addrlen, text.data(), text.size(),
                                  nullptr, 0, NI_NUMERICHOST);
    if (error != 0) {
        throw std::runtime_error("cannot listen on " + host + ": " + gai_strerror(error));
    }
    const std::string numeric = text.data();
    return {numeric, found->ai_family == AF_INET6, numeric == "0.0.0.0" || numeric == "::"};
}

std::string listen_problem(const ListenAddress& address, std::uint16_t port) {
    const AddressList found = look_up(address.numeric, std::to_string(port));
    const int listener = socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (listener < 0) {
        return std::generic_category().message(errno);
    }
    const int yes = 1;
    setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    const bool listens =
        bind(listener, found->ai_addr, found->ai_addrlen) == 0 && listen(listener, 1) == 0;
    std::string problem = listens ? "" : std::generic_category().message(errno);
    close(listener);
    return problem;
}

std::string host_and_port(const std::string& host, std::uint16_t port) {
    const bool brackets = host.find(':') != std::string::npos;
    return (brackets ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

}  // namespace raybundle
