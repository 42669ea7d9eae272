// SPDX-License-Identifier: Apache-2.0
#include "soak_viewers.h"

#include <chrono>
#include <cmath>
#include <exception>

#include "json_viewer.h"

namespace raybundle {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int width = 640;
constexpr int height = 360;
constexpr auto camera_interval = std::chrono::milliseconds(50);
constexpr auto flap_interval = std::chrono::milliseconds(500);

/// A place on an arc in front of the Cornell box.
Json camera(int step, int number) {
    const double angle = 0.02 * step + 0.7 * number;
    return {{"eye", {{"x", 2.75 + 2.0 * std::sin(angle)}, {"y", 2.75}, {"z", -7.5}}},
            {"target", {{"x", 2.75}, {"y", 2.75}, {"z", 2.75}}}};
}

}  // namespace

SoakViewer::SoakViewer(std::uint16_t port, bool moving, int number)
    : thread_([this, port, moving, number](const std::stop_token& token) {
          try {
              run(port, moving, number, token);
          } catch (const std::exception& error) {
              const std::lock_guard lock(mutex_);
              problem_ = error.what();
          }
      }) {}

void SoakViewer::run(std::uint16_t port, bool moving, int number, const std::stop_token& token) {
    JsonViewer viewer(port);
    if (const Json answer = viewer.join("", width, height); !answer.contains("welcome")) {
        throw std::runtime_error(answer.dump());
    }
    for (int step = 1; !token.stop_requested(); ++step) {
        const auto start = Clock::now();
        if (moving) {
            viewer.send({{"id", step}, {"setCamera", camera(step, number)}});
        }
        const Json frame = viewer.next_frame([&](const Json& header) {
            ++frames_;
            return !moving || header["cameraId"] == step || token.stop_requested();
        });
        if (frame.empty() && moving) {
            throw std::runtime_error("no frame for 20 s, or the connection is closed");
        }
        if (moving) {
            const std::chrono::duration<double, std::milli> latency = Clock::now() - start;
            {
                const std::lock_guard lock(mutex_);
                latencies_.push_back(latency.count());
            }
            std::this_thread::sleep_until(start + camera_interval);
        }
    }
}

std::string SoakViewer::stop() {
    thread_.request_stop();
    if (thread_.joinable()) {
        thread_.join();
    }
    return problem_;
}

std::vector<double> SoakViewer::latencies() {
    const std::lock_guard lock(mutex_);
    return latencies_;
}

class HostileClients::Stalled {
  public:
    explicit Stalled(std::uint16_t port) : client_(port, 4096) {
        client_.upgrade();
        client_.send_text(
            R"({"id":1,"hello":{"protocol":"1.0","viewport":{"width":640,"height":360}}})");
    }

  private:
    RawClient client_;
};

HostileClients::HostileClients(std::uint16_t port, int stalled, int flapping) {
    for (int i = 0; i < stalled; ++i) {
        stalled_.push_back(std::make_unique<Stalled>(port));
    }
    for (int i = 0; i < flapping; ++i) {
        flapping_.emplace_back([this, port](const std::stop_token& token) {
            while (!token.stop_requested()) {
                try {
                    RawClient client(port);
                    client.upgrade();
                    client.send_text(
                        R"({"hello":{"protocol":"1.0","viewport":{"width":640,"height":360}}})");
                    client.send(std::string("\x81\xfe\x01\x00\x11\x22\x33\x44{\"set", 13));
                    client.reset();
                    ++flaps_;
                } catch (const std::exception&) {
                    // Refused: so be it.
                }
                std::this_thread::sleep_for(flap_interval);
            }
        });
    }
}

HostileClients::~HostileClients() = default;

}  // namespace raybundle
