// SPDX-License-Identifier: Apache-2.0
// A server under load for as long as one likes: 16 viewers, half of them moving, then 2 beside a
// crowd of stalled and flapping connections, then 2 beside a snapshot. Prints figures, and status 1
// where one is not what two cores that do nothing else are expected to show.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "daemon.h"
#include "json_viewer.h"
#include "soak_figures.h"
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
constexpr double most_growth = 0.02;       // of memory, after it has settled
constexpr double least_settling_s = 30.0;  // shorter runs say nothing about memory
constexpr double least_rate = 3.0;         // frames a second of each viewer that moves
constexpr double most_loss = 0.1;          // of the good viewers' rate, to the crowd
constexpr double most_snapshot_loss = 0.2;
constexpr double coarse_iterations = 1000.0;
constexpr int most_warm_up_s = 300;
constexpr double alone_share = 0.25;  // of the time of a comparison, before what it is about
constexpr double most_light_change = 0.03;
constexpr int light_iterations = 1024;  // noise of the mean over 30 places: below 1 %

void sleep_s(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Waits until bundles are no longer coarse: the first iterations are cheaper, and what fine
/// bundles need in memory comes at once with the first of them.
void warm_up(std::uint16_t port) {
    for (int i = 0;
         i < most_warm_up_s && !(metric(port, "raybundle_iterations_total") >= coarse_iterations);
         ++i) {
        sleep_s(1.0);
    }
}

/// Ends viewers; says who was lost.
void stop(Viewers& all, Expectations& expected) {
    for (auto& viewer : all) {
        if (const std::string problem = viewer->stop(); !problem.empty()) {
            expected.expect(false, "a viewer was lost: " + problem);
        }
    }
}

void report(Daemon& daemon, const Footprint& seen, Expectations& expected) {
    fmt::print("  memory {:.1f} MiB after {:.0f} s, {:.1f} MiB at the end\n", seen.settled,
               seen.settling_s, seen.last);
    fmt::print("  {:.0f} iterations, {:.1f} a second at the end, error {}\n",
               metric(daemon.port(), "raybundle_iterations_total"),
               metric(daemon.port(), "raybundle_iterations_per_second"),
               std::isnan(seen.error) ? "unknown: nobody rested"
                                      : fmt::format("{:.2f} %", 100.0 * seen.error));
    fmt::print("  the server had {:.2f} cores\n", seen.cores);
    const std::string said = daemon.output();
    fmt::print("{}", said.substr(std::min(said.size(), said.find('\n') + 1)));
    const std::string growth = fmt::format("memory {:+.1f} %", 100.0 * seen.growth());
    if (seen.settling_s >= least_settling_s) {
        expected.expect(seen.growth() <= most_growth, growth);
    } else {
        fmt::print("  {}, too short a time to judge\n", growth);
    }
    const double non_finite = metric(daemon.port(), "raybundle_non_finite_total");
    expected.expect(non_finite == 0.0, fmt::format("{:.0f} non-finite contributions", non_finite));
}

void print_latency(const std::vector<double>& latencies) {
    fmt::print("  camera to frame: median {:.0f} ms, p95 {:.0f} ms\n", percentile(latencies, 0.5),
               percentile(latencies, 0.95));
}

/// Compares the light of a server under load with that of one that nobody disturbs.
void compare_light(std::uint16_t port, Expectations& expected) {
    const std::vector<double> loaded = light_of(port, light_iterations);
    const Daemon undisturbed(scene_file("cornell_box.gltf"), {"--log-level", "warn"});
    const std::vector<double> alone = light_of(undisturbed.port(), light_iterations);
    double sum = 0.0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
        sum += alone[i] > 0.0 ? loaded[i] / alone[i] - 1.0 : 0.0;
    }
    const double change = sum / static_cast<double>(alone.size());
    expected.expect(std::abs(change) <= most_light_change,
                    fmt::format("light {:+.2f} % against an undisturbed server", 100.0 * change));
}

void many_viewers(double seconds, Expectations& expected) {
    fmt::print("{} viewers of 640x360, {} moving, {:.0f} s\n", viewers, moving, seconds);
    Daemon daemon(scene_file("cornell_box.gltf"),
                  {"--min-frames-per-second", "0.1", "--log-level", "warn"});
    warm_up(daemon.port());
    Viewers all;
    for (int i = 0; i < viewers; ++i) {
        all.push_back(std::make_unique<SoakViewer>(daemon.port(), i < moving, i));
    }
    const Footprint seen = watch(daemon, seconds);
    std::vector<double> rates, latencies;
    for (int i = 0; i < moving; ++i) {
        SoakViewer& viewer = *all[static_cast<std::size_t>(i)];
        rates.push_back(static_cast<double>(viewer.frames()) / seconds);
        const std::vector<double> some = viewer.latencies();
        latencies.insert(latencies.end(), some.begin(), some.end());
    }
    const auto [least, most] = std::minmax_element(rates.begin(), rates.end());
    report(daemon, seen, expected);
    print_latency(latencies);
    expected.expect(*least >= least_rate,
                    fmt::format("moving viewers: {:.1f} to {:.1f} frames/s", *least, *most));
    stop(all, expected);
    compare_light(daemon.port(), expected);
}

/// Two viewers that move, and what they get while something else goes on.
class GoodViewers {
  public:
    explicit GoodViewers(std::uint16_t port) {
        for (int i = 0; i < good_viewers; ++i) {
            viewers_.push_back(std::make_unique<SoakViewer>(port, true, i));
        }
        warm_up(port);
        begin();
    }

    /// What follows is measured by itself.
    void begin() {
        first_ = frames();
        since_ = Clock::now();
        seen_latencies_.clear();
        for (auto& viewer : viewers_) {
            seen_latencies_.push_back(viewer->latencies().size());
        }
    }

    /// Frames a second of each since begin().
    [[nodiscard]] double rate() const {
        const std::chrono::duration<double> elapsed = Clock::now() - since_;
        return (frames() - first_) / elapsed.count() / good_viewers;
    }

    [[nodiscard]] std::vector<double> latencies() {
        std::vector<double> result;
        for (std::size_t i = 0; i < viewers_.size(); ++i) {
            const std::vector<double> all = viewers_[i]->latencies();
            result.insert(result.end(),
                          all.begin() + static_cast<std::ptrdiff_t>(seen_latencies_[i]), all.end());
        }
        return result;
    }

    void stop(Expectations& expected) { raybundle::stop(viewers_, expected); }

  private:
    [[nodiscard]] double frames() const {
        double sum = 0.0;
        for (const auto& viewer : viewers_) {
            sum += static_cast<double>(viewer->frames());
        }
        return sum;
    }

    Viewers viewers_;
    double first_ = 0.0;
    Clock::time_point since_;
    std::vector<std::size_t> seen_latencies_;
};

void hostile_crowd(double seconds, Expectations& expected) {
    fmt::print("{} viewers beside {} stalled and {} flapping connections, {:.0f} s\n", good_viewers,
               stalled, flapping, seconds);
    Daemon daemon(scene_file("cornell_box.gltf"),
                  {"--min-frames-per-second", "0.1", "--max-viewers", "300", "--max-connections",
                   "600", "--log-level", "warn"});
    GoodViewers good(daemon.port());
    sleep_s(alone_share * seconds);
    const double alone = good.rate();
    const HostileClients crowd(daemon.port(), stalled, flapping);
    good.begin();
    const Footprint seen = watch(daemon, (1.0 - alone_share) * seconds);
    const double beside = good.rate();
    report(daemon, seen, expected);
    print_latency(good.latencies());
    fmt::print("  {} flaps\n", crowd.flaps());
    expected.expect(
        beside >= (1.0 - most_loss) * alone,
        fmt::format("each good viewer: {:.1f} frames/s alone, {:.1f} in the crowd", alone, beside));
    good.stop(expected);
}

void snapshot_beside(double seconds, Expectations& expected) {
    fmt::print("{} viewers beside a snapshot of 1920x1080, {:.0f} s\n", good_viewers, seconds);
    Daemon daemon(scene_file("cornell_box.gltf"), {"--log-level", "warn"});
    GoodViewers good(daemon.port());
    JsonViewer asking(daemon.port());
    asking.join("", 64, 48);
    sleep_s(alone_share * seconds);
    const double alone = good.rate();
    asking.send(
        {{"id", 1},
         {"snapshot",
          {{"width", 1920}, {"height", 1080}, {"relativeError", 0.002}, {"format", "EXR"}}}});
    good.begin();
    sleep_s((1.0 - alone_share) * seconds);
    const double beside = good.rate();
    expected.expect(beside >= (1.0 - most_snapshot_loss) * alone,
                    fmt::format("each viewer: {:.1f} frames/s alone, {:.1f} beside the snapshot",
                                alone, beside));
    good.stop(expected);
}

}  // namespace
}  // namespace raybundle

namespace {

struct Phase {
    std::string_view name;
    double share;  ///< of the time where all are run
    void (*run)(double seconds, raybundle::Expectations& expected);
};

}  // namespace

int main(int count, char** arguments) {
    const double minutes = count >= 2 ? std::atof(arguments[1]) : 0.0;
    const std::string_view only = count == 3 ? arguments[2] : "";
    const std::vector<Phase> phases{{"many", 0.6, raybundle::many_viewers},
                                    {"crowd", 0.3, raybundle::hostile_crowd},
                                    {"snapshot", 0.1, raybundle::snapshot_beside}};
    const bool known = only.empty() || std::any_of(phases.begin(), phases.end(),
                                                   [&](const Phase& p) { return p.name == only; });
    if (!(minutes >= 0.2 && minutes <= 100000.0) || count > 3 || !known) {
        fmt::print(stderr, "usage: raybundle_soak MINUTES [many|crowd|snapshot] (0.2 or more)\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    try {
        raybundle::Expectations expected;
        for (const Phase& phase : phases) {
            if (only.empty() || only == phase.name) {
                phase.run(60.0 * minutes * (only.empty() ? phase.share : 1.0), expected);
            }
        }
        fmt::print("{}\n", expected.all_hold() ? "fine" : "FAILED");
        return expected.all_hold() ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "soak: {}\n", error.what());
        return 1;
    }
}
