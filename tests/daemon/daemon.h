// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <csignal>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace raybundle {

/// A running `raybundle serve`, or another command that serves, on a free port of this machine.
class Daemon {
  public:
    /// Starts it and waits until it listens. `options` follow the scene. It keeps a journal where
    /// they name one, or XDG_STATE_HOME is set. Throws std::runtime_error
    /// with its output where it ends instead.
    explicit Daemon(const std::string& scene, const std::vector<std::string>& options = {});
    /// Only starts it: wait_for_address() has to follow before port().
    struct Unready {};
    Daemon(Unready unready, const std::string& scene, const std::vector<std::string>& options);
    /// Another command, with its arguments; waits until it listens.
    struct Command {
        std::vector<std::string> arguments;
    };
    explicit Daemon(const Command& command);
    /// Another command that listens nowhere.
    Daemon(Unready unready, const Command& command);
    void wait_for_address();
    ~Daemon();  ///< kills it if need be
    Daemon(const Daemon&) = delete;
    Daemon& operator=(const Daemon&) = delete;

    [[nodiscard]] std::uint16_t port() const { return port_; }
    [[nodiscard]] pid_t process() const { return process_; }
    void signal(int number) const;

    /// Waits for the end: the exit status, or minus the signal that ended it. Nothing where it
    /// still runs after five minutes.
    std::optional<int> wait();

    /// Sends a signal and waits.
    std::optional<int> end(int number = SIGTERM) {
        signal(number);
        return wait();
    }

    /// What it has written so far, log included.
    std::string output();

    /// Waits until the output holds a text. False: not in five minutes.
    bool says(const std::string& text);

  private:
    void start(const std::vector<std::string>& arguments);
    bool read_some(int timeout_ms);

    pid_t process_ = -1;
    int pipe_ = -1;
    std::uint16_t port_ = 0;
    std::string output_;
};

/// Scene of the repository, by its path there.
std::string scene_file(const std::string& name);

}  // namespace raybundle
