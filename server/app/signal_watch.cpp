// SPDX-License-Identifier: Apache-2.0
#include "app/signal_watch.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <ctime>
#include <utility>

namespace raybundle {

void hold_hangup() {
    constexpr std::uint64_t kHangup = std::uint64_t{1} << (SIGHUP - 1U);
    syscall(SYS_rt_sigprocmask, SIG_BLOCK, &kHangup, nullptr, sizeof kHangup);
}

void release_hangup() {
    sigset_t hangup{};
    sigemptyset(&hangup);
    sigaddset(&hangup, SIGHUP);
    pthread_sigmask(SIG_UNBLOCK, &hangup, nullptr);
}

SignalWatch::SignalWatch(std::function<void()> stop, std::function<void()> reload)
    : stop_(std::move(stop)), reload_(std::move(reload)) {
    sigemptyset(&signals_);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        sigaddset(&signals_, number);
    }
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    // A limit on the size of files (ulimit -f) is a full disk, not the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    thread_ = std::jthread([this](const std::stop_token& token) { watch(token); });
}

void SignalWatch::watch(const std::stop_token& token) const {
    const timespec interval{0, 100'000'000};
    while (!token.stop_requested()) {
        const int number = sigtimedwait(&signals_, nullptr, &interval);
        if (number == SIGHUP) {
            reload_();
        } else if (number > 0) {
            stop_();
        }
    }
}

}  // namespace raybundle
