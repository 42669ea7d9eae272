// SPDX-License-Identifier: Apache-2.0
#include "projects/server_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <system_error>

namespace raybundle {
namespace {

constexpr std::size_t max_line = 8192;

/// In the new process, before it becomes another program: calls the kernel alone.
[[noreturn]] void become(char* const* arguments, int log, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) {
        _exit(0);
    }
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    execv("/proc/self/exe", arguments);
    _exit(127);
}

/// Bytes of a line "RssAnon:  123 kB" of /proc/PID/status.
std::uint64_t kilobytes_in(const std::string& line) {
    std::istringstream words(line.substr(line.find(':') + 1));
    std::uint64_t kilobytes = 0;
    words >> kilobytes;
    return kilobytes * 1024;
}

std::uint64_t memory_of(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    std::uint64_t bytes = 0;
    for (std::string line; std::getline(status, line);) {
        for (const char* name : {"RssAnon:", "RssShmem:", "VmSwap:"}) {
            bytes += line.starts_with(name) ? kilobytes_in(line) : 0;
        }
    }
    return bytes;
}

double processor_time_of(pid_t process) {
    std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
    std::string text;
    std::getline(stat, text);
    // Behind the program's name, which may have blanks: state is the third field, utime the 14th.
    std::istringstream words(text.substr(std::min(text.rfind(')') + 1, text.size())));
    std::string passed_over;
    constexpr int fields_before = 11;
    for (int i = 0; i < fields_before; ++i) {
        words >> passed_over;
    }
    double user = 0.0;
    double system = 0.0;
    words >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace

ServerProcess::ServerProcess(std::string name, const std::vector<std::string>& arguments,
                             std::string address_file)
    : name_(std::move(name)), address_file_(std::move(address_file)) {
    std::remove(address_file_.c_str());
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw std::system_error(errno, std::generic_category(), "pipe");
    }
    log_ = Descriptor(ends[0]);
    const Descriptor written(ends[1]);
    fcntl(log_.get(), F_SETFL, O_NONBLOCK);
    std::string program = "raybundle";
    std::vector<char*> pointers{program.data()};
    for (const std::string& argument : arguments) {
        pointers.push_back(const_cast<char*>(argument.c_str()));
    }
    pointers.push_back(nullptr);
    const pid_t parent = getpid();
    process_ = fork();
    if (process_ == 0) {
        become(pointers.data(), written.get(), parent);
    }
    if (process_ < 0) {
        throw std::system_error(errno, std::generic_category(), "fork");
    }
}

ServerProcess::~ServerProcess() {
    if (!ended()) {
        kill();
        waitpid(process_, nullptr, 0);
    }
    read_log();
}

std::optional<int> ServerProcess::ended() {
    int status = 0;
    if (!status_ && waitpid(process_, &status, WNOHANG) == process_) {
        status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
        read_log();
    }
    return status_;
}

std::optional<std::uint16_t> ServerProcess::port() {
    if (port_) {
        return port_;
    }
    std::ifstream file(address_file_);
    std::string address;
    std::getline(file, address);
    const std::size_t colon = address.rfind(':');
    std::uint16_t number = 0;
    if (colon != std::string::npos &&
        std::from_chars(address.data() + colon + 1, address.data() + address.size(), number).ec ==
            std::errc()) {
        port_ = number;
    }
    return port_;
}

/// Once it has been waited for, its number may be that of another.
void ServerProcess::signal(int number) const {
    if (!status_) {
        ::kill(process_, number);
    }
}

void ServerProcess::pause() const {
    signal(SIGSTOP);
}

void ServerProcess::resume() const {
    signal(SIGCONT);
}

void ServerProcess::end() const {
    signal(SIGTERM);
    signal(SIGCONT);
}

void ServerProcess::kill() const {
    signal(SIGKILL);
}

void ServerProcess::reload() const {
    signal(SIGHUP);
}

ProcessUsage ServerProcess::usage() const {
    return status_ ? ProcessUsage{}
                   : ProcessUsage{memory_of(process_), processor_time_of(process_)};
}

void ServerProcess::add_to(PollSet& set) {
    entry_ = set.add(log_.get(), POLLIN);
}

void ServerProcess::step(const PollSet& set) {
    if (set.readable(entry_)) {
        read_log();
    }
}

void ServerProcess::read_log() {
    std::array<char, max_line> bytes;  // NOLINT: read() writes what is read
    while (log_.open()) {
        const auto count = read(log_.get(), bytes.data(), bytes.size());
        if (count <= 0) {
            if (count == 0) {
                log_.reset();
            }
            return;
        }
        line_.append(bytes.data(), static_cast<std::size_t>(count));
        for (std::size_t end = 0;
             (end = line_.find('\n')) != std::string::npos || (end = max_line) <= line_.size();) {
            take_line(std::string_view(line_).substr(0, end));
            line_.erase(0, end + (line_.size() > end && line_[end] == '\n' ? 1 : 0));
        }
    }
}

void ServerProcess::take_line(std::string_view line) {
    has_scene_ = has_scene_ || line.starts_with("raybundle serves ");
    std::fputs(named_line(name_, line).c_str(), stderr);
}

std::string named_line(std::string_view name, std::string_view line) {
    const bool json = line.starts_with("{\"") && line.ends_with('}');
    std::string text = json ? "{\"project\":\"" : "";
    text += name;
    text += json ? "\"," : ": ";
    text += json ? line.substr(1) : line;
    return text + "\n";
}

}  // namespace raybundle
