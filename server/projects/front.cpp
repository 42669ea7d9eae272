// SPDX-License-Identifier: Apache-2.0
#include "projects/front.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

#include "net/access/listen_address.h"

namespace raybundle {
namespace {

constexpr int backlog = 256;
constexpr auto between_attempts = std::chrono::milliseconds(100);
/// For servers to say goodbye, which they do within seconds.
constexpr auto longest_stop = std::chrono::seconds(15);
constexpr int idle_ms = 250;
constexpr int in_between_ms = 10;

Descriptor listen_on(const std::string& host, std::uint16_t port) {
    const ListenAddress numeric = resolve_listen_address(host);
    addrinfo hints{};
    hints.ai_family = numeric.is_ipv6 ? AF_INET6 : AF_INET;
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_PASSIVE | AI_NUMERICHOST;
    addrinfo* found = nullptr;
    const int failed =
        getaddrinfo(numeric.numeric.c_str(), std::to_string(port).c_str(), &hints, &found);
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> address(found, &freeaddrinfo);
    Descriptor listener(
        failed != 0 ? -1
                    : socket(address->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const int yes = 1;
    setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (!listener.open() || bind(listener.get(), address->ai_addr, address->ai_addrlen) != 0 ||
        listen(listener.get(), backlog) != 0) {
        throw std::runtime_error("cannot listen on " + host_and_port(host, port) + ": " +
                                 std::generic_category().message(errno));
    }
    return listener;
}

std::uint16_t port_of(int listener) {
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    getsockname(listener, reinterpret_cast<sockaddr*>(&storage), &size);
    return ntohs(storage.ss_family == AF_INET6
                     ? reinterpret_cast<const sockaddr_in6&>(storage).sin6_port
                     : reinterpret_cast<const sockaddr_in&>(storage).sin_port);
}

Descriptor take_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int number : {SIGTERM, SIGINT, SIGHUP, SIGCHLD}) {
        sigaddset(&signals, number);
    }
    sigprocmask(SIG_BLOCK, &signals, nullptr);
    return Descriptor(signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK));
}

/// Each visit takes two descriptors.
void allow_many_descriptors() {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0) {
        limit.rlim_cur = limit.rlim_max;
        setrlimit(RLIMIT_NOFILE, &limit);
    }
}

/// Whoever is gone without a word is noticed in a minute.
void prepare(int client) {
    const int yes = 1;
    const int idle_s = 30;
    const int between_s = 10;
    const int probes = 3;
    setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    setsockopt(client, SOL_SOCKET, SO_KEEPALIVE, &yes, sizeof yes);
    setsockopt(client, IPPROTO_TCP, TCP_KEEPIDLE, &idle_s, sizeof idle_s);
    setsockopt(client, IPPROTO_TCP, TCP_KEEPINTVL, &between_s, sizeof between_s);
    setsockopt(client, IPPROTO_TCP, TCP_KEEPCNT, &probes, sizeof probes);
}

}  // namespace

Front::Front(FrontSettings settings)
    : settings_(std::move(settings)),
      projects_(settings_),
      pages_(projects_),
      listener_(listen_on(settings_.host, settings_.port)),
      signals_(take_signals()) {
    pages_.set_tokens(settings_.tokens);
    allow_many_descriptors();
    settings_.port = port_of(listener_.get());
}

std::string Front::address() const {
    return "http://" + host_and_port(settings_.host, settings_.port);
}

void Front::run(const std::function<FrontSettings()>& reload) {
    while (FrontClock::now() < stop_until_) {
        turn(FrontClock::now());
        if (reload_asked_) {
            set_settings(reload);
        }
        if (stop_asked_ && listener_.open()) {
            stop(FrontClock::now());
        }
        if (!listener_.open() && !projects_.any_runs() && visits_.empty()) {
            return;
        }
    }
    spdlog::warn("some servers have not ended in time");
}

void Front::turn(FrontTime now) {
    set_.clear();
    const bool listens = now >= accept_again_;
    listener_entry_ = set_.add(listener_.get(), listens ? POLLIN : 0);
    signals_entry_ = set_.add(signals_.get(), POLLIN);
    projects_.add_to(set_);
    for (const auto& visit : visits_) {
        visit->add_to(set_);
    }
    set_.wait(patience_ms());
    now = FrontClock::now();
    if (set_.readable(signals_entry_)) {
        read_signals();
    }
    projects_.step(set_, now);
    for (const auto& visit : visits_) {
        visit->step(set_, now);
    }
    std::erase_if(visits_, [this](const std::unique_ptr<Visit>& visit) {
        if (visit->done()) {
            addresses_.remove(visit->peer().key);
        }
        return visit->done();
    });
    if (set_.readable(listener_entry_)) {
        accept_clients(now);
    }
    pages_.note_connections(visits_.size());
}

int Front::patience_ms() const {
    const bool waiting =
        projects_.in_between() || std::any_of(visits_.begin(), visits_.end(),
                                              [](const auto& visit) { return visit->waits(); });
    return waiting ? in_between_ms : idle_ms;
}

void Front::read_signals() {
    signalfd_siginfo signal{};
    while (read(signals_.get(), &signal, sizeof signal) == sizeof signal) {
        stop_asked_ |= signal.ssi_signo == SIGTERM || signal.ssi_signo == SIGINT;
        reload_asked_ |= signal.ssi_signo == SIGHUP;
    }
}

void Front::set_settings(const std::function<FrontSettings()>& reload) {
    reload_asked_ = false;
    try {
        const FrontSettings fresh = reload();
        projects_.set_settings(fresh);
        pages_.set_tokens(fresh.tokens);
        spdlog::info("settings have been read again: projects, tokens, limits");
    } catch (const std::exception& error) {
        spdlog::error("settings stay as they were: {}", error.what());
    }
}

bool Front::accepts(const PeerAddress& peer) const {
    return visits_.size() < settings_.max_connections &&
           (peer.loopback || addresses_.of(peer.key) < settings_.max_connections_per_address);
}

void Front::accept_clients(FrontTime now) {
    for (;;) {
        Descriptor client(accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
        if (!client.open()) {
            const bool exhausted = errno == EMFILE || errno == ENFILE || errno == ENOBUFS;
            accept_again_ = exhausted ? now + between_attempts : accept_again_;
            return;
        }
        PeerAddress peer = peer_address(client.get());
        if (accepts(peer)) {
            prepare(client.get());
            addresses_.add(peer.key);
            visits_.push_back(std::make_unique<Visit>(std::move(client), std::move(peer), projects_,
                                                      pages_, now));
        }
    }
}

void Front::stop(FrontTime now) {
    spdlog::info("stopping");
    listener_.reset();
    stop_until_ = now + longest_stop;
    for (const auto& visit : visits_) {
        visit->say_goodbye(now);
    }
    projects_.end_all(now);
}

}  // namespace raybundle
