// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <functional>
#include <thread>

namespace raybundle {

/// Keeps SIGHUP waiting, for a SignalWatch or release_hangup(): until somebody can answer it, it
/// would end the program. For .preinit_array: it calls the kernel alone, since no library has been
/// made ready by then.
void hold_hangup();
/// SIGHUP ends the program, as usual.
void release_hangup();

/// Waits for signals on a thread of its own. Make it before any other thread, since they inherit
/// which signals are blocked.
class SignalWatch {
  public:
    /// `stop` is called at SIGINT and SIGTERM, `reload` at SIGHUP.
    SignalWatch(std::function<void()> stop, std::function<void()> reload);

  private:
    void watch(const std::stop_token& token) const;

    std::function<void()> stop_, reload_;
    sigset_t signals_{};
    std::jthread thread_;
};

}  // namespace raybundle
