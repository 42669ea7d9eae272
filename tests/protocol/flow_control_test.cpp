// SPDX-License-Identifier: Apache-2.0
// Real connections over bad lines: a server that always has a new frame, viewers that acknowledge,
// and between them a token bucket. The long versions, labelled heavy, try all lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "link_proxy.h"
#include "net/server.h"
#include "raw_client.h"

namespace raybundle {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPixels = 640.0 * 360.0;
constexpr double kFrameMs = 33.0;

/// Frames of a typical interior for whoever can take one, as a render loop would send them.
class FrameSource {
  public:
    explicit FrameSource(Server& server) : server_(server) {
        thread_ = std::jthread([this](const std::stop_token& token) { run(token); });
    }

    void set_moving(bool moving) { moving_ = moving; }

  private:
    void run(const std::stop_token& token) {
        while (!token.stop_requested()) {
            for (const ClientEvent& event : server_.inbox().drain()) {
                if (event.kind == ClientEvent::Kind::joined) {
                    v1::ServerMessage welcome;
                    welcome.mutable_welcome()->set_viewer(event.viewer);
                    server_.reply(event, welcome);
                    due_[event.viewer] = 0.0;
                } else if (event.kind == ClientEvent::Kind::left) {
                    due_.erase(event.viewer);
                }
            }
            for (auto& [viewer, due_ms] : due_) {
                offer(viewer, due_ms);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    void offer(ViewerId viewer, double& due_ms) {
        const double now = Server::now_ms();
        if (now < due_ms) {
            return;
        }
        const FrameAdvice advice = server_.advise(viewer, {moving_, false, kPixels});
        if (!advice.send) {
            return;
        }
        due_ms = now + kFrameMs;
        v1::FrameHeader header;
        header.set_frame(++frame_);
        header.set_width(640);
        header.set_height(360);
        header.set_quality(static_cast<unsigned>(advice.quality));
        header.set_server_time_ms(now);
        const double bytes = kPixels * advice.scale * advice.scale * 0.12 *
                             std::pow(2.0, (advice.quality - 80) / 15.0);
        server_.send_frame(viewer, header,
                           std::vector<std::uint8_t>(static_cast<std::size_t>(bytes), 7));
    }

    Server& server_;
    std::atomic<bool> moving_{true};
    std::map<ViewerId, double> due_;
    std::uint32_t frame_ = 0;
    std::jthread thread_;
};

struct Arrival {
    double at_ms = 0.0;   ///< on the server's clock, which this process shares
    double age_ms = 0.0;  ///< since it was rendered
    std::uint32_t frame = 0;
};

/// A viewer that acknowledges every frame and keeps a record.
class Viewer {
  public:
    explicit Viewer(std::uint16_t port) : client_(port) {
        client_.upgrade();
        client_.send_text(R"({"id":1,"hello":{"protocol":"1.0"}})");
        thread_ = std::jthread([this](const std::stop_token& token) { run(token); });
    }
    ~Viewer() {
        thread_.request_stop();
        thread_.join();
    }
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    [[nodiscard]] std::vector<Arrival> arrivals(double from_ms, double to_ms = 1e300) const {
        const std::lock_guard lock(mutex_);
        std::vector<Arrival> result;
        std::copy_if(arrivals_.begin(), arrivals_.end(), std::back_inserter(result),
                     [&](const Arrival& a) { return a.at_ms >= from_ms && a.at_ms < to_ms; });
        return result;
    }

  private:
    void run(const std::stop_token& token) {
        while (!token.stop_requested()) {
            const auto message = client_.read_message();
            if (!message) {
                continue;
            }
            if (message->opcode != 2) {
                continue;
            }
            v1::FrameHeader header = read_header(message->payload);
            client_.send_text(R"({"ack":{"frame":)" + std::to_string(header.frame()) +
                              R"(,"decodeMs":0}})");
            const double now = Server::now_ms();
            const std::lock_guard lock(mutex_);
            arrivals_.push_back({now, now - header.server_time_ms(), header.frame()});
        }
    }

    static v1::FrameHeader read_header(const std::string& payload) {
        v1::FrameHeader header;
        const auto number = [&](const std::string& key) {
            const std::size_t found = payload.find("\"" + key + "\":");
            return std::stod(payload.substr(found + key.size() + 3, 32));
        };
        header.set_frame(static_cast<std::uint32_t>(number("frame")));
        header.set_server_time_ms(number("serverTimeMs"));
        return header;
    }

    RawClient client_;
    mutable std::mutex mutex_;
    std::vector<Arrival> arrivals_;
    std::jthread thread_;
};

double percentile(std::vector<Arrival> arrivals, double share) {
    if (arrivals.empty()) {
        return 1e300;
    }
    std::sort(arrivals.begin(), arrivals.end(),
              [](const Arrival& a, const Arrival& b) { return a.age_ms < b.age_ms; });
    return arrivals[static_cast<std::size_t>(share * static_cast<double>(arrivals.size() - 1))]
        .age_ms;
}

void wait_ms(double ms) {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(ms));
}

ServerSettings settings() {
    ServerSettings result;
    result.port = 0;
    return result;
}

/// Median age of frames on a line: half a round trip there, at most the delay aimed at, and what
/// one frame occupies the line. What a busy machine adds is measured with a viewer on no line.
double allowed_age_ms(const LinkProxy::Line& line, double machine_ms) {
    const double slack_ms = 150.0 + 4.0 * machine_ms;  // frames and acknowledgements, both ends
    const double smallest_frame_bits = kPixels * 0.25 * 0.12 * std::pow(2.0, -40.0 / 15.0) * 8.0;
    return 0.5 * line.rtt_ms + std::max(100.0, line.rtt_ms) +
           smallest_frame_bits / (line.mbit_per_s * 1000.0) + slack_ms;
}

void expect_bounded_delay(LinkProxy::Line line, double seconds) {
    Server server(settings());
    server.start();
    FrameSource source(server);
    const LinkProxy proxy(server.port(), line);
    const Viewer viewer(proxy.port());
    const Viewer control(server.port());
    wait_ms(3000.0);  // to find out what the line is like
    const double from = Server::now_ms();
    wait_ms(1000.0 * seconds);
    const auto arrivals = viewer.arrivals(from);
    EXPECT_GE(static_cast<double>(arrivals.size()), 2.0 * seconds) << "frames have almost stopped";
    const double machine_ms = percentile(control.arrivals(from), 0.5);
    EXPECT_LE(percentile(arrivals, 0.5), allowed_age_ms(line, machine_ms))
        << line.mbit_per_s << " Mbit/s, " << line.rtt_ms << " ms";
    for (std::size_t i = 1; i < arrivals.size(); ++i) {
        EXPECT_GT(arrivals[i].frame, arrivals[i - 1].frame);
    }
}

/// The line of one of two viewers is cut; afterwards it shows the present again within a second,
/// and the other has noticed nothing.
void expect_recovery(LinkProxy::Line line, double stall_ms) {
    Server server(settings());
    server.start();
    FrameSource source(server);
    LinkProxy proxy(server.port(), line);
    const Viewer other(server.port());
    const Viewer viewer(proxy.port());
    wait_ms(3000.0);
    const double before_from = Server::now_ms() - 2000.0;
    const double stall_from = Server::now_ms();
    proxy.set_stalled(true);
    wait_ms(stall_ms);
    proxy.set_stalled(false);
    const double stall_to = Server::now_ms();
    wait_ms(3000.0);

    constexpr double kSlackMs = 300.0;
    const auto late = viewer.arrivals(stall_to + 1000.0 + kSlackMs);
    EXPECT_GE(late.size(), 3U);
    const double machine_ms = percentile(other.arrivals(stall_to), 0.9);
    EXPECT_LE(percentile(late, 0.9), allowed_age_ms(line, machine_ms) + line.rtt_ms)
        << "latency recovers";
    // Replayed would be what was rendered during the stall; what was on its way at its beginning is
    // at most a window of frames.
    const auto after = viewer.arrivals(stall_to);
    const auto stale = std::count_if(after.begin(), after.end(), [&](const Arrival& a) {
        const double rendered = a.at_ms - a.age_ms;
        return rendered > stall_from + 1000.0 && rendered < stall_to - 500.0;
    });
    EXPECT_LE(stale, 1) << "frames of the stall are replayed";
    const auto rate = [&](double from, double to) {
        return static_cast<double>(other.arrivals(from, to).size()) / (to - from);
    };
    EXPECT_GE(rate(stall_from, stall_to), 0.9 * rate(before_from, stall_from));
}

TEST(FlowControl, DelayStaysBoundedOnASlowLine) {
    expect_bounded_delay({2.0, 20.0}, 3.0);
}

TEST(FlowControl, AStallIsForgottenWithinASecond) {
    expect_recovery({20.0, 20.0}, 2000.0);
}

class FlowControlHeavy : public testing::TestWithParam<LinkProxy::Line> {};

TEST_P(FlowControlHeavy, DelayStaysBounded) {
    expect_bounded_delay(GetParam(), 20.0);
}

TEST_P(FlowControlHeavy, AStallOfFiveSecondsIsForgottenWithinASecond) {
    expect_recovery(GetParam(), 5000.0);
}

INSTANTIATE_TEST_SUITE_P(Lines, FlowControlHeavy,
                         testing::Values(LinkProxy::Line{0.3, 20.0}, LinkProxy::Line{0.3, 150.0},
                                         LinkProxy::Line{2.0, 20.0}, LinkProxy::Line{2.0, 150.0},
                                         LinkProxy::Line{20.0, 20.0},
                                         LinkProxy::Line{20.0, 150.0}));

}  // namespace
}  // namespace raybundle
