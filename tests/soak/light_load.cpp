// SPDX-License-Identifier: Apache-2.0
// Many who draw by themselves beside a server that solves: what joining takes, bytes and processor
// time for each of them, and how long a change of a lamp takes to reach them. Some acknowledge
// nothing. Prints figures; status 1 where somebody was lost, or who acknowledges nothing got more
// than a window.
#include <fmt/core.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "daemon.h"
#include "json_viewer.h"
#include "raw_client.h"
#include "soak_figures.h"

namespace raybundle {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_of_silent = 32768;  // bytes of light, a window
constexpr auto change_interval = std::chrono::seconds(2);
constexpr auto patience = std::chrono::seconds(120);

void sleep_s(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// When changes were asked for, by epoch.
class Changes {
  public:
    void note(std::uint32_t epoch, Clock::time_point at) {
        const std::lock_guard lock(mutex_);
        asked_.resize(std::max<std::size_t>(asked_.size(), epoch + 1));
        asked_[epoch] = at;
    }
    /// Nothing arrives before it is asked for.
    [[nodiscard]] double ms_since(std::uint32_t epoch, Clock::time_point now) const {
        const std::lock_guard lock(mutex_);
        return epoch < asked_.size()
                   ? std::chrono::duration<double, std::milli>(now - asked_[epoch]).count()
                   : -1.0;
    }

  private:
    mutable std::mutex mutex_;
    std::vector<Clock::time_point> asked_;
};

/// Takes in light and acknowledges it, or not; never looks at a picture.
class LoadViewer {
  public:
    LoadViewer(std::uint16_t port, bool acknowledges, const Changes& changes)
        : thread_([this, port, acknowledges, &changes](const std::stop_token& token) {
              try {
                  run(port, acknowledges, changes, token);
              } catch (const std::exception& error) {
                  lost = !token.stop_requested();
              }
          }) {}

    void stop() {
        thread_.request_stop();
        if (socket_ >= 0) {
            ::shutdown(socket_, SHUT_RDWR);
        }
        thread_.join();
    }

    std::atomic<std::size_t> bytes{0};
    std::atomic<bool> joined{false}, lost{false};
    std::vector<double> arrivals_ms;  ///< once it has been stopped

  private:
    void run(std::uint16_t port, bool acknowledges, const Changes& changes,
             const std::stop_token& token) {
        RawClient client(port);
        socket_ = client.socket();
        client.upgrade();
        client.send_text(R"({"id":1,"hello":{"protocol":"1.0","name":"load","light":true,)"
                         R"("viewport":{"width":16,"height":16}}})");
        std::uint32_t epoch = 0;
        while (!token.stop_requested()) {
            const auto message = client.read_message();
            if (token.stop_requested()) {
                return;
            }
            if (!message || message->opcode == 8) {
                throw std::runtime_error("connection lost");
            }
            if (message->opcode != 2) {
                continue;
            }
            const auto first = static_cast<unsigned char>(message->payload.at(0));
            const std::size_t length =
                first + 256U * static_cast<unsigned char>(message->payload.at(1));
            const Json header = Json::parse(message->payload.substr(4, length));
            if (!header.contains("light")) {
                continue;
            }
            bytes += message->payload.size();
            joined = true;
            if (header["epoch"] > epoch) {
                epoch = header["epoch"];
                arrivals_ms.push_back(changes.ms_since(epoch, Clock::now()));
            }
            if (acknowledges) {
                client.send_text(R"({"ackLight":{"light":)" +
                                 std::to_string(header["light"].get<unsigned>()) + "}}");
            }
        }
    }

    std::atomic<int> socket_{-1};
    std::jthread thread_;
};

std::size_t bytes_of(const std::vector<std::unique_ptr<LoadViewer>>& viewers, std::size_t from,
                     std::size_t to) {
    std::size_t sum = 0;
    for (std::size_t i = from; i < to; ++i) {
        sum += viewers[i]->bytes;
    }
    return sum;
}

/// Has one viewer change the lamp every two seconds; it looks at pictures, too.
void change_lamps(JsonViewer& editor, double seconds, Changes& changes) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    std::uint32_t epoch = 0;
    while (Clock::now() < end) {
        const auto next = Clock::now() + change_interval;
        changes.note(++epoch, Clock::now());
        editor.request(
            {{"setLight", {{"light", 1}, {"intensity", epoch % 2 == 0 ? 1355.0 : 700.0}}}});
        while (Clock::now() < std::min<Clock::time_point>(
                                  next, std::chrono::time_point_cast<Clock::duration>(end))) {
            editor.next_frame([](const Json&) { return true; });
        }
    }
}

int load(std::size_t count, std::size_t silent, double seconds) {
    fmt::print("{} viewers of the light stream, {} of them acknowledge nothing; {:.0f} s\n", count,
               silent, seconds);
    Daemon daemon(scene_file("cornell_box.gltf"),
                  {"--max-viewers", "1000", "--log-level", "warn", "--journal", "none"});
    Changes changes;
    std::vector<std::unique_ptr<LoadViewer>> viewers;
    const auto begun = Clock::now();
    for (std::size_t i = 0; i < count; ++i) {
        viewers.push_back(std::make_unique<LoadViewer>(daemon.port(), i >= silent, changes));
    }
    while (Clock::now() - begun < patience &&
           !std::all_of(viewers.begin(), viewers.end(),
                        [](const auto& v) { return v->joined.load(); })) {
        sleep_s(0.05);
    }
    sleep_s(3.0);
    const double joining = static_cast<double>(bytes_of(viewers, silent, count)) /
                           static_cast<double>(std::max<std::size_t>(count - silent, 1));
    fmt::print("  all have joined after {:.1f} s; {:.0f} bytes of light each\n",
               std::chrono::duration<double>(Clock::now() - begun).count() - 3.0, joining);
    JsonViewer editor(daemon.port());
    editor.join("", 320, 240);
    editor.next_frame([](const Json&) { return true; });
    const std::size_t before = bytes_of(viewers, silent, count);
    Footprint seen;
    std::jthread watcher([&] { seen = watch(daemon, seconds); });
    change_lamps(editor, seconds, changes);
    watcher.join();
    const auto hearing = static_cast<double>(std::max<std::size_t>(count - silent, 1));
    const double rate =
        static_cast<double>(bytes_of(viewers, silent, count) - before) / hearing / seconds;
    std::size_t most = 0;
    for (std::size_t i = 0; i < silent; ++i) {
        most = std::max(most, viewers[i]->bytes.load());
    }
    Expectations expected;
    std::vector<double> arrivals;
    std::size_t lost = 0;
    for (auto& viewer : viewers) {
        viewer->stop();
        lost += viewer->lost ? 1 : 0;
        arrivals.insert(arrivals.end(), viewer->arrivals_ms.begin(), viewer->arrivals_ms.end());
    }
    fmt::print(
        "  {:.0f} bytes a second each; the server had {:.2f} cores, {:.3f} ms a second for each "
        "viewer\n",
        rate, seen.cores,
        1000.0 * seen.cores / static_cast<double>(std::max<std::size_t>(count, 1)));
    fmt::print("  change to its light: median {:.0f} ms, p95 {:.0f} ms, of {} arrivals\n",
               percentile(arrivals, 0.5), percentile(arrivals, 0.95), arrivals.size());
    fmt::print("  memory {:.1f} MiB at the end, {:+.1f} %\n", seen.last, 100.0 * seen.growth());
    expected.expect(lost == 0, fmt::format("{} viewers were lost", lost));
    expected.expect(most <= 2 * most_of_silent,
                    fmt::format("who acknowledges nothing got {} bytes at most", most));
    return expected.all_hold() ? 0 : 1;
}

}  // namespace
}  // namespace raybundle

int main(int count, char** arguments) {
    try {
        const std::size_t viewers = count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 999;
        const std::size_t silent = count > 2 ? std::strtoul(arguments[2], nullptr, 10) : 20;
        const double seconds = count > 3 ? std::strtod(arguments[3], nullptr) : 60.0;
        if (viewers == 0 || viewers > 999 || silent > viewers || !(seconds > 0.0)) {
            fmt::print(stderr,
                       "usage: raybundle_light_load [VIEWERS (1..999) [SILENT [SECONDS]]]\n");
            return 2;
        }
        return raybundle::load(viewers, silent, seconds);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
