// SPDX-License-Identifier: Apache-2.0
#include "daemon.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace raybundle {
namespace {

/// The state folder of whoever runs the tests is not theirs: one test would go on with what another
/// has changed. Tests that want one set the variable.
[[maybe_unused]] const int forgotten = unsetenv("XDG_STATE_HOME");

using Clock = std::chrono::steady_clock;

// Only what hangs takes so long, with sanitizers on a busy machine either.
constexpr auto kStartTime = std::chrono::seconds(300);
constexpr auto kEndTime = std::chrono::seconds(300);
constexpr auto kTalkTime = std::chrono::seconds(300);
constexpr std::string_view kAnnouncement = "raybundle serves ";
constexpr std::string_view kAddress = "://127.0.0.1:";

}  // namespace

std::string scene_file(const std::string& name) {
    return std::string(RAYBUNDLE_ROOT) + "/scenes/" + name;
}

Daemon::Daemon(const std::string& scene, const std::vector<std::string>& options)
    : Daemon(Unready{}, scene, options) {
    wait_for_address();
}

Daemon::Daemon(Unready /*unready*/, const std::string& scene,
               const std::vector<std::string>& options) {
    std::vector<std::string> arguments{RAYBUNDLE_EXECUTABLE, "serve", scene, "--listen",
                                       "127.0.0.1:0"};
    const std::string journal = "--journal";
    const bool chosen = std::find(options.begin(), options.end(), journal) != options.end();
    if (!chosen && getenv("XDG_STATE_HOME") == nullptr) {
        arguments.insert(arguments.end(),
                         {journal, "none"});  // the user's own folder stays as it is
    }
    arguments.insert(arguments.end(), options.begin(), options.end());
    start(arguments);
}

Daemon::Daemon(const Command& command) : Daemon(Unready{}, command) {
    wait_for_address();
}

Daemon::Daemon(Unready /*unready*/, const Command& command) {
    std::vector<std::string> arguments{RAYBUNDLE_EXECUTABLE};
    arguments.insert(arguments.end(), command.arguments.begin(), command.arguments.end());
    start(arguments);
}

void Daemon::wait_for_address() {
    const auto end = Clock::now() + kStartTime;
    std::size_t found = 0;
    // Other addresses may have been logged before.
    while ((found = output_.find(kAnnouncement)) == std::string::npos ||
           (found = output_.find(kAddress, found)) == std::string::npos ||
           output_.find('\n', found) == std::string::npos) {
        if (Clock::now() > end || !read_some(200)) {
            throw std::runtime_error("the server does not start:\n" + output_);
        }
    }
    port_ = static_cast<std::uint16_t>(std::stoi(output_.substr(found + kAddress.size())));
}

void Daemon::start(const std::vector<std::string>& arguments) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe");
    }
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        dup2(ends[1], STDOUT_FILENO);
        dup2(ends[1], STDERR_FILENO);
        execv(argv[0], argv.data());
        _exit(127);
    }
    close(ends[1]);
    pipe_ = ends[0];
}

Daemon::~Daemon() {
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    close(pipe_);
}

void Daemon::signal(int number) const {
    kill(process_, number);
}

std::optional<int> Daemon::wait() {
    const auto end = Clock::now() + kEndTime;
    int status = 0;
    while (waitpid(process_, &status, WNOHANG) == 0) {
        if (Clock::now() > end) {
            return std::nullopt;
        }
        read_some(20);
    }
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

bool Daemon::read_some(int timeout_ms) {
    pollfd ready{pipe_, POLLIN, 0};
    if (poll(&ready, 1, timeout_ms) == 0) {
        return true;
    }
    std::array<char, 4096> bytes{};
    const auto count = read(pipe_, bytes.data(), bytes.size());
    if (count <= 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(timeout_ms / 10));
        return false;
    }
    output_.append(bytes.data(), static_cast<std::size_t>(count));
    return true;
}

std::string Daemon::output() {
    read_some(0);
    return output_;
}

bool Daemon::says(const std::string& text) {
    const auto end = Clock::now() + kTalkTime;
    while (output_.find(text) == std::string::npos) {
        if (Clock::now() > end) {
            return false;
        }
        read_some(50);
    }
    return true;
}

}  // namespace raybundle
