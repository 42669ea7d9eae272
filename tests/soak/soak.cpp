// SPDX-License-Identifier: Apache-2.0
// A server under load for as long as one likes: 16 viewers, half of them moving, then 2 beside a
// crowd of stalled and flapping connections. Prints figures; status 1 where memory grows, a viewer
// is lost or a contribution was not finite. Times are reported, not judged: they are the machine's.
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>

#include "daemon.h"
#include "raw_client.h"
#include "soak_viewers.h"

namespace raybundle {
namespace {

using Clock = std::chrono::steady_clock;
using Viewers = std::vector<std::unique_ptr<SoakViewer>>;

constexpr int viewers = 16;
constexpr int moving = 8;
constexpr int good_viewers = 2;
constexpr int stalled = 100;
constexpr int flapping = 50;
constexpr double most_growth = 0.02;  // of memory, after it has settled
constexpr double settling_s = 60.0;   // or half of the time, where that is shorter
constexpr double sample_s = 1.0;

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

double metric(std::uint16_t port, const std::string& name) {
    const std::string text =
        http_exchange(port, "GET /metrics HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
    const std::size_t found = text.find("\n" + name + " ");
    return found == std::string::npos ? std::nan("")
                                      : std::stod(text.substr(found + name.size() + 2));
}

/// The server's memory over a phase, MiB: once settled, and the mean of the last quarter.
struct Footprint {
    double settled = 0.0;
    double last = 0.0;
    double cores = 0.0;  ///< that the server had, mean

    [[nodiscard]] double growth() const { return last / settled - 1.0; }
};

Footprint watch(Daemon& daemon, double seconds) {
    const double settling = std::min(settling_s, 0.5 * seconds);
    constexpr double last_share = 0.75;  // from here on it is the end
    std::vector<double> before, after;
    const double processor = processor_seconds(daemon.process());
    const auto start = Clock::now();
    while (seconds_since(start) < seconds) {
        std::this_thread::sleep_for(std::chrono::duration<double>(sample_s));
        daemon.output();  // a pipe that nobody reads would stop the server
        const double now = seconds_since(start);
        if (now >= settling && now < std::min(2.0 * settling, last_share * seconds)) {
            before.push_back(resident_mib(daemon.process()));
        } else if (now >= last_share * seconds) {
            after.push_back(resident_mib(daemon.process()));
        }
    }
    const auto mean = [](const std::vector<double>& values) {
        double sum = 0.0;
        for (const double value : values) {
            sum += value;
        }
        return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
    };
    const double cores = (processor_seconds(daemon.process()) - processor) / seconds_since(start);
    return {mean(before), mean(after), cores};
}

double percentile(std::vector<double> values, double share) {
    if (values.empty()) {
        return std::nan("");
    }
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Ends viewers; false where one was lost.
bool stop(Viewers& all) {
    bool fine = true;
    for (auto& viewer : all) {
        if (const std::string problem = viewer->stop(); !problem.empty()) {
            fmt::print("  LOST: {}\n", problem);
            fine = false;
        }
    }
    return fine;
}

bool report(Daemon& daemon, const Footprint& memory) {
    const double non_finite = metric(daemon.port(), "raybundle_non_finite_total");
    fmt::print("  memory {:.1f} MiB settled, {:.1f} MiB at the end ({:+.1f} %)\n", memory.settled,
               memory.last, 100.0 * memory.growth());
    fmt::print("  {:.0f} iterations, {:.1f} a second at the end, error {:.4f}, {:.0f} non-finite\n",
               metric(daemon.port(), "raybundle_iterations_total"),
               metric(daemon.port(), "raybundle_iterations_per_second"),
               metric(daemon.port(), "raybundle_relative_error"), non_finite);
    fmt::print("  the server had {:.2f} cores\n", memory.cores);
    const std::string said = daemon.output();
    fmt::print("{}", said.substr(std::min(said.size(), said.find('\n') + 1)));
    return memory.growth() <= most_growth && non_finite == 0.0;
}

bool many_viewers(double seconds) {
    fmt::print("{} viewers of 640x360, {} moving, {:.0f} s\n", viewers, moving, seconds);
    Daemon daemon(scene_file("cornell_box.gltf"),
                  {"--min-frames-per-second", "0.1", "--log-level", "warn"});
    Viewers all;
    for (int i = 0; i < viewers; ++i) {
        all.push_back(std::make_unique<SoakViewer>(daemon.port(), i < moving, i));
    }
    const Footprint memory = watch(daemon, seconds);
    std::vector<double> rates, latencies;
    for (int i = 0; i < moving; ++i) {
        SoakViewer& viewer = *all[static_cast<std::size_t>(i)];
        rates.push_back(static_cast<double>(viewer.frames()) / seconds);
        const std::vector<double> some = viewer.latencies();
        latencies.insert(latencies.end(), some.begin(), some.end());
    }
    const bool flat = report(daemon, memory);
    fmt::print(
        "  moving viewers: {:.1f} to {:.1f} frames/s; camera to frame: median {:.0f} ms, "
        "p95 {:.0f} ms\n",
        *std::min_element(rates.begin(), rates.end()),
        *std::max_element(rates.begin(), rates.end()), percentile(latencies, 0.5),
        percentile(latencies, 0.95));
    return stop(all) && flat;
}

bool hostile_crowd(double seconds) {
    fmt::print("{} viewers beside {} stalled and {} flapping connections, {:.0f} s\n", good_viewers,
               stalled, flapping, seconds);
    Daemon daemon(scene_file("cornell_box.gltf"),
                  {"--min-frames-per-second", "0.1", "--max-viewers", "300", "--max-connections",
                   "600", "--log-level", "warn"});
    Viewers all;
    for (int i = 0; i < good_viewers; ++i) {
        all.push_back(std::make_unique<SoakViewer>(daemon.port(), true, i));
    }
    const auto frames = [&] {
        std::uint64_t sum = 0;
        for (const auto& viewer : all) {
            sum += viewer->frames();
        }
        return static_cast<double>(sum);
    };
    const double alone_s = 0.25 * seconds;
    std::this_thread::sleep_for(std::chrono::duration<double>(alone_s));
    const double alone = frames();
    const HostileClients crowd(daemon.port(), stalled, flapping);
    const Footprint memory = watch(daemon, seconds - alone_s);
    const double rate = (frames() - alone) / (seconds - alone_s) / good_viewers;
    fmt::print("  each good viewer: {:.1f} frames/s alone, {:.1f} in the crowd; {} flaps\n",
               alone / alone_s / good_viewers, rate, crowd.flaps());
    const bool flat = report(daemon, memory);
    return stop(all) && flat;
}

}  // namespace
}  // namespace raybundle

int main(int count, char** arguments) {
    const double minutes = count >= 2 ? std::atof(arguments[1]) : 0.0;
    const std::string_view only = count == 3 ? arguments[2] : "";
    if (!(minutes >= 0.2 && minutes <= 100000.0) || count > 3 ||
        !(only.empty() || only == "many" || only == "crowd")) {
        fmt::print(stderr, "usage: raybundle_soak MINUTES [many|crowd] (0.2 or more)\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    try {
        const double s = 60.0 * minutes;
        const bool first = only == "crowd" || raybundle::many_viewers(only.empty() ? 0.6 * s : s);
        const bool second = only == "many" || raybundle::hostile_crowd(only.empty() ? 0.4 * s : s);
        fmt::print("{}\n", first && second ? "fine" : "FAILED");
        return first && second ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "soak: {}\n", error.what());
        return 1;
    }
}
