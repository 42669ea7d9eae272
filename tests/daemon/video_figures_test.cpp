// SPDX-License-Identifier: Apache-2.0
// What a walk takes over a slow line, as JPEG and as VP9: `build/raybundle_daemon_tests
// --gtest_filter='VideoFiguresHeavy*'` prints it (docs/performance.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "daemon.h"
#include "json_viewer.h"
#include "link_proxy.h"
#include "stream/video_encoder.h"

namespace raybundle {
namespace {

using Steady = std::chrono::steady_clock;

constexpr int kWidth = 800;
constexpr int kHeight = 600;

double ms_since(Steady::time_point begin) {
    return std::chrono::duration<double, std::milli>(Steady::now() - begin).count();
}

struct WalkFigures {
    int frames = 0, keys = 0;
    double bytes = 0.0;
    double width = 0.0, quality = 0.0;  ///< sums over frames
    std::vector<double> latency_ms;     ///< from a camera message to its frame
    int video = 0;
};

/// Walks to and fro before the box for so long.
class Walker {
  public:
    Walker(std::uint16_t port, const Json& codecs) : client_(port) {
        client_.upgrade();
        const Json hello = {{"protocol", "1.0"},
                            {"codecs", codecs},
                            {"viewport", {{"width", kWidth}, {"height", kHeight}}}};
        send({{"id", 1}, {"hello", hello}});
    }

    WalkFigures walk(double warm_ms, double walk_ms) {
        const auto begin = Steady::now();
        std::jthread feet([&](const std::stop_token& token) {
            while (!token.stop_requested()) {
                step();
                std::this_thread::sleep_for(std::chrono::milliseconds(40));
            }
        });
        WalkFigures figures;
        while (ms_since(begin) < warm_ms + walk_ms) {
            const auto message = client_.read_message();
            if (!message || message->opcode == 8) {
                break;
            }
            if (message->opcode == 2) {
                take(message->payload, ms_since(begin) >= warm_ms, figures);
            }
        }
        return figures;
    }

  private:
    void send(const Json& message) {
        const std::lock_guard lock(mutex_);
        client_.send_text(message.dump());
    }

    void step() {
        int id = 0;
        {
            const std::lock_guard lock(mutex_);
            id = ++camera_;
            sent_[id] = Steady::now();
        }
        const double aside = std::sin(0.05 * id);
        send({{"id", id},
              {"setCamera",
               {{"eye", {{"x", 2.7 + aside}, {"y", 2.7}, {"z", -7.0 + 0.5 * aside}}},
                {"target", {{"x", 2.7 + 0.5 * aside}, {"y", 2.7}, {"z", 2.7}}}}}});
    }

    void take(const std::string& payload, bool counts, WalkFigures& figures) {
        std::size_t length = 0;
        for (std::size_t i = 4; i-- > 0;) {
            length = 256 * length + static_cast<unsigned char>(payload.at(i));
        }
        const Json header = Json::parse(payload.substr(4, length));
        send({{"ack", {{"frame", header["frame"]}, {"decodeMs", 0}}}});
        if (!counts) {
            return;
        }
        ++figures.frames;
        figures.bytes += static_cast<double>(payload.size());
        figures.video += header["codec"] == "VP9" ? 1 : 0;
        figures.keys += header.value("key", false) ? 1 : 0;
        figures.width += header["width"].get<double>();
        figures.quality += header["quality"].get<double>();
        const std::lock_guard lock(mutex_);
        if (const auto found = sent_.find(header["cameraId"].get<int>()); found != sent_.end()) {
            figures.latency_ms.push_back(ms_since(found->second));
            sent_.erase(sent_.begin(), std::next(found));
        }
    }

    RawClient client_;
    std::mutex mutex_;
    int camera_ = 1;
    std::map<int, Steady::time_point> sent_;
};

double percentile(std::vector<double> values, double share) {
    if (values.empty()) {
        return 0.0;
    }
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

TEST(VideoFiguresHeavy, AWalkOverSlowLinesTakesFewerBytesAsVideo) {
    if (!VideoEncoder::available()) {
        GTEST_SKIP() << "built without libvpx";
    }
    const Daemon daemon(scene_file("cornell_box.gltf"));
    std::printf("Mbit/s codec frames/s kB/frame width quality keys latency_ms p95\n");
    constexpr double kWalkMs = 10e3;
    for (const double mbit_per_s : {0.5, 2.0, 20.0}) {
        std::map<std::string, double> bytes;
        for (const char* const codec : {"JPEG", "VP9"}) {
            const LinkProxy proxy(daemon.port(), {mbit_per_s, 20.0});
            Walker walker(proxy.port(), Json::array({codec, "JPEG"}));
            const WalkFigures f = walker.walk(3000.0, kWalkMs);
            ASSERT_GT(f.frames, 10);
            const double n = f.frames;
            bytes[codec] = f.bytes / n;
            std::printf("%6.1f %5s %8.1f %8.2f %5.0f %7.0f %4d %10.0f %3.0f\n", mbit_per_s, codec,
                        n / kWalkMs * 1e3, f.bytes / n / 1e3, f.width / n, f.quality / n, f.keys,
                        percentile(f.latency_ms, 0.5), percentile(f.latency_ms, 0.95));
            EXPECT_EQ(f.video > 0, codec == std::string("VP9"));
        }
        EXPECT_LT(bytes["VP9"], 1.1 * bytes["JPEG"]) << mbit_per_s << " Mbit/s";
    }
}

}  // namespace
}  // namespace raybundle
