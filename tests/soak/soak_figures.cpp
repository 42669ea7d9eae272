// SPDX-License-Identifier: Apache-2.0
#include "soak_figures.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "json_viewer.h"
#include "raw_client.h"

namespace raybundle {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double settling_s = 60.0;  // or half of the time, where that is shorter
constexpr double last_share = 0.75;  // from here on it is the end
constexpr double sample_s = 1.0;
constexpr int light_width = 96;
constexpr int light_height = 72;
constexpr int light_step = 16;  // pixels between two places

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Resident memory of a process, MiB.
double resident_mib(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    std::string line;
    while (std::getline(status, line)) {
        if (line.starts_with("VmRSS:")) {
            return std::stod(line.substr(6)) / 1024.0;
        }
    }
    return 0.0;
}

/// Processor time that a process has taken, s.
double processor_seconds(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string text;
    std::getline(file, text);
    constexpr int user_time = 12;  // fields after the name in brackets, proc(5)
    std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
    std::string skipped;
    for (int i = 1; i < user_time; ++i) {
        fields >> skipped;
    }
    double user = 0.0;
    double system = 0.0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double mean(const std::vector<double>& values) {
    return values.empty() ? 0.0
                          : std::accumulate(values.begin(), values.end(), 0.0) /
                                static_cast<double>(values.size());
}

int iterations_in(const Json& message) {
    return message.contains("solution") ? message["solution"].value("iterations", 0) : -1;
}

}  // namespace

double metric(std::uint16_t port, const std::string& name) {
    const std::string text =
        http_exchange(port, "GET /metrics HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
    const std::size_t found = text.find("\n" + name + " ");
    return found == std::string::npos ? std::nan("")
                                      : std::stod(text.substr(found + name.size() + 2));
}

Footprint watch(Daemon& daemon, double seconds) {
    Footprint result;
    result.settling_s = std::min(settling_s, 0.5 * seconds);
    result.error = std::nan("");
    std::vector<double> before, after;
    const double processor = processor_seconds(daemon.process());
    const auto start = Clock::now();
    while (seconds_since(start) < seconds) {
        std::this_thread::sleep_for(std::chrono::duration<double>(sample_s));
        daemon.output();  // a pipe that nobody reads would stop the server
        const double now = seconds_since(start);
        const double settled_until = std::min(2.0 * result.settling_s, last_share * seconds);
        if (now >= result.settling_s && now < settled_until) {
            before.push_back(resident_mib(daemon.process()));
        } else if (now >= last_share * seconds) {
            after.push_back(resident_mib(daemon.process()));
        }
        const double error = metric(daemon.port(), "raybundle_relative_error");
        result.error = std::isnan(error) ? result.error : error;
    }
    result.cores = (processor_seconds(daemon.process()) - processor) / seconds_since(start);
    result.settled = mean(before);
    result.last = mean(after);
    return result;
}

double percentile(std::vector<double> values, double share) {
    if (values.empty()) {
        return std::nan("");
    }
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::vector<double> light_of(std::uint16_t port, int more_iterations) {
    JsonViewer viewer(port);
    if (!viewer.join("", light_width, light_height).contains("welcome")) {
        throw std::runtime_error("the viewer that looks at the light is not let in");
    }
    const int begin = iterations_in(viewer.next_with("solution"));
    const Json enough = viewer.next(
        [&](const Json& message) { return iterations_in(message) >= begin + more_iterations; });
    if (enough.empty()) {
        throw std::runtime_error("the solver does not go on");
    }
    std::vector<double> result;
    for (int y = light_step / 2; y < light_height; y += light_step) {
        for (int x = light_step / 2; x < light_width; x += light_step) {
            const Json answer = viewer.request({{"probe", {{"pixel", {{"x", x}, {"y", y}}}}}});
            if (!answer.contains("probeResult")) {
                throw std::runtime_error("no answer to a probe: " + answer.dump());
            }
            result.push_back(answer["probeResult"].value("luminance", 0.0));
        }
    }
    return result;
}

void Expectations::expect(bool holds, const std::string& what) {
    fmt::print("  {}: {}\n", holds ? "as expected" : "NOT AS EXPECTED", what);
    all_hold_ = all_hold_ && holds;
}

}  // namespace raybundle
