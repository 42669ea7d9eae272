// SPDX-License-Identifier: Apache-2.0
#include "redis_server.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <utility>

namespace raybundle {
namespace {

constexpr int timeout_ms = 5000;
constexpr auto start_time = std::chrono::seconds(60);  // only what hangs takes so long

std::uint16_t free_port() {
    const int probe = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const raw = reinterpret_cast<sockaddr*>(&address);
    const bool found = bind(probe, raw, size) == 0 && getsockname(probe, raw, &size) == 0;
    close(probe);
    if (!found) {
        throw std::runtime_error("no free port");
    }
    return ntohs(address.sin_port);
}

}  // namespace

RedisServer::RedisServer(std::vector<std::string> options)
    : options_(std::move(options)), port_(free_port()) {
    start();
}

RedisServer::~RedisServer() {
    kill_it();
}

void RedisServer::kill_it() {
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
        process_ = -1;
    }
}

void RedisServer::lose_data() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        std::filesystem::remove_all(entry.path());
    }
}

void RedisServer::freeze() const {
    kill(process_, SIGSTOP);
}

void RedisServer::thaw() const {
    kill(process_, SIGCONT);
}

void RedisServer::start() {
    std::vector<std::string> arguments{"redis-server",
                                       "--port",
                                       std::to_string(port_),
                                       "--bind",
                                       "127.0.0.1",
                                       "--dir",
                                       folder_.path(""),
                                       "--appendonly",
                                       "yes",
                                       "--appendfsync",
                                       "always",
                                       "--save",
                                       "",
                                       "--logfile",
                                       folder_.path("redis.log")};
    arguments.insert(arguments.end(), options_.begin(), options_.end());
    std::vector<char*> argv;
    for (std::string& argument : arguments) {
        argv.push_back(argument.data());
    }
    argv.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        execvp(argv[0], argv.data());
        _exit(127);
    }
    const auto end = std::chrono::steady_clock::now() + start_time;
    while (!answers()) {
        int status = 0;
        if (waitpid(process_, &status, WNOHANG) != 0) {
            process_ = -1;
            throw std::runtime_error(
                "redis-server does not start; Debian's package is redis-server");
        }
        if (std::chrono::steady_clock::now() > end) {
            throw std::runtime_error("redis-server does not answer");
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

bool RedisServer::answers() const {
    try {
        command({"PING"});
        return true;
    } catch (const std::runtime_error& error) {
        // A user that may not ask is an answer, too; while it reads its file it says LOADING.
        return std::string(error.what()).find("NOAUTH") != std::string::npos;
    }
}

RedisAddress RedisServer::address() const {
    return {"127.0.0.1", port_, "", ""};
}

RedisReply RedisServer::command(const std::vector<std::string>& words) const {
    return RedisConnection(address(), timeout_ms).command(words);
}

}  // namespace raybundle
