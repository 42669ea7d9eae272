// SPDX-License-Identifier: Apache-2.0
// Servers and Redis are killed at random moments while two clients change things. What was
// acknowledged is in the log, once; what failed is asked for again under its key, maybe of the
// other server.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <random>
#include <thread>

#include "daemon.h"
#include "journal/redis/stream_entry.h"
#include "json_viewer.h"
#include "redis_server.h"

namespace raybundle {
namespace {

constexpr int kKills = 8;
constexpr int kChangesBetween = 3;  ///< acknowledged, at least, from one kill to the next

using Ports = std::array<std::atomic<std::uint16_t>, 2>;

/// A client that does not give up.
class Changer {
  public:
    Changer(int number, const Ports& ports) : number_(number), ports_(ports) {}

    /// Changes until there are `enough`; each again until it is acknowledged.
    void run(const std::atomic<bool>& enough, std::atomic<int>& made) {
        for (int i = 0; !enough; ++i) {
            Json request = number_ == 0
                               ? Json{{"setLight", {{"light", 1}, {"intensity", 300.0 + i}}}}
                               : Json{{"moveObject",
                                       {{"object", kShortBox},
                                        {"transform",
                                         {{"translation",
                                           {{"x", 1.5 + 0.002 * i}, {"y", 0.825}, {"z", 1.7}}}}}}}};
            const std::string key = std::to_string(number_) + "-" + std::to_string(i);
            request["requestKey"] = key;
            acknowledged[key] = epoch_of(request);
            ++made;
        }
    }

    std::map<std::string, std::uint32_t> acknowledged;  ///< epochs by key

  private:
    std::uint32_t epoch_of(const Json& request) {
        for (;;) {
            try {
                if (!viewer_) {
                    viewer_ = std::make_unique<JsonViewer>(
                        ports_[static_cast<std::size_t>(turn_++ % 2)].load());
                    if (!viewer_->join({}, 32, 24).contains("welcome")) {
                        throw std::runtime_error("not welcome");
                    }
                }
                const Json answer = viewer_->request(request);
                if (answer.contains("sceneChanged")) {
                    return answer.at("sceneChanged").at("epoch").get<std::uint32_t>();
                }
                if (answer.empty()) {
                    viewer_.reset();
                }
            } catch (const std::exception&) {
                viewer_.reset();
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }

    int number_;
    const Ports& ports_;
    int turn_ = number_;
    std::unique_ptr<JsonViewer> viewer_;
};

std::vector<StreamEntry> entries_of(const RedisServer& redis) {
    return parse_entries(redis.command({"XRANGE", "raybundle:{box}:log", "-", "+"}));
}

/// Each key once, at the epoch that was told; no epoch is missing.
void expect_once(const std::vector<StreamEntry>& entries, const Changer& changer) {
    std::map<std::string, std::vector<std::uint32_t>> epochs;
    for (const StreamEntry& entry : entries) {
        for (const RequestKey& key : entry.entry.keys) {
            epochs[key.text].push_back(entry.entry.change.epoch());
        }
    }
    for (const auto& [key, epoch] : changer.acknowledged) {
        EXPECT_EQ(epochs[key], std::vector<std::uint32_t>{epoch}) << key;
    }
}

TEST(Chaos, NothingAcknowledgedIsLostOrDoubled) {
    RedisServer redis;
    const std::vector<std::string> options{"--redis", redis.text(), "--project", "box"};
    std::array<std::unique_ptr<Daemon>, 2> daemons;
    Ports ports{};
    const auto start = [&](std::size_t i) {
        daemons[i] = std::make_unique<Daemon>(scene_file("cornell_box.gltf"), options);
        ports[i] = daemons[i]->port();
    };
    start(0);
    start(1);
    std::atomic<bool> enough{false};
    std::array<Changer, 2> changers{Changer(0, ports), Changer(1, ports)};
    std::atomic<int> made{0};
    std::thread first([&] { changers[0].run(enough, made); });
    std::thread second([&] { changers[1].run(enough, made); });
    std::mt19937 random(11);
    for (int i = 0; i < kKills; ++i) {
        for (const int before = made; made < before + kChangesBetween;) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % 300));
        const std::size_t victim = i % 3;
        if (victim == 2) {
            redis.kill_it();
            std::this_thread::sleep_for(std::chrono::milliseconds(random() % 300));
            redis.start();
        } else {
            kill(daemons[victim]->process(), SIGKILL);
            daemons[victim]->wait();
            start(victim);
        }
    }
    enough = true;
    first.join();
    second.join();
    const std::vector<StreamEntry> entries = entries_of(redis);
    expect_once(entries, changers[0]);
    expect_once(entries, changers[1]);
    const auto last = static_cast<std::uint32_t>(entries.back().id.epoch);
    EXPECT_EQ(std::count_if(entries.begin(), entries.end(),
                            [](const StreamEntry& entry) { return entry.is_change; }),
              last);
    Json places;
    for (const auto& daemon : daemons) {
        Json welcome;
        do {
            JsonViewer viewer(daemon->port());
            welcome = viewer.join({}, 32, 24).at("welcome");
        } while (welcome.at("epoch") != last);
        const Json now{welcome.at("scene").at("objects"), welcome.at("scene").at("lights")};
        EXPECT_TRUE(places.is_null() || places == now) << places.dump() << now.dump();
        places = now;
    }
}

}  // namespace
}  // namespace raybundle
