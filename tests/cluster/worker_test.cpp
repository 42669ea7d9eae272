// SPDX-License-Identifier: Apache-2.0
// Daemons of one project add up their light, with one that has no viewers.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"
#include "raw_client.h"
#include "redis_server.h"

namespace raybundle::worker_test {
namespace {

/// What /metrics says.
class Metrics {
  public:
    explicit Metrics(const Daemon& server)
        : text_(http_exchange(server.port(),
                              "GET /metrics HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n")) {}
    /// -1: there is no such figure.
    [[nodiscard]] int operator[](const std::string& name) const {
        const std::size_t found = text_.find("\n" + name + " ");
        return found == std::string::npos ? -1 : std::stoi(text_.substr(found + name.size() + 2));
    }

  private:
    std::string text_;
};

/// Until the light of so many others is merged in this state of the scene.
void wait_for(const Daemon& server, int epoch, int workers) {
    for (;;) {
        const Metrics metrics(server);
        if (metrics["raybundle_epoch"] == epoch && metrics["raybundle_merged_workers"] == workers) {
            return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

TEST(HeavyWorker, SolvesForTheServerOfItsProject) {
    const RedisServer redis;
    const std::string scene = scene_file("cornell_box.gltf");
    const std::vector<std::string> common{"--redis", redis.text(),   "--project",
                                          "box",     "--patch-size", "1"};
    Daemon server(scene, common);
    std::vector<std::string> arguments{"work", scene};
    arguments.insert(arguments.end(), common.begin(), common.end());
    Daemon worker(Daemon::Unready{}, Daemon::Command{arguments});
    ASSERT_TRUE(server.says("is ready")) << server.output();
    wait_for(server, 0, 1);
    EXPECT_EQ(Metrics(server)["raybundle_exchange_refused_total"], 0);
    // It follows the log: after a change its light is of the scene as it is now.
    JsonViewer viewer(server.port());
    viewer.join({}, 32, 24);
    EXPECT_TRUE(viewer.request({{"setLight", {{"light", 1}, {"intensity", 500.0}}}})
                    .contains("sceneChanged"));
    wait_for(server, 1, 1);
    EXPECT_EQ(worker.end(SIGTERM), 0) << worker.output();
}

TEST(Worker, SaysWhatItLacks) {
    const RedisServer redis;
    const std::string scene = scene_file("cornell_box.gltf");
    Daemon lonely(Daemon::Unready{}, Daemon::Command{{"work", scene}});
    EXPECT_EQ(lonely.wait(), 2);
    EXPECT_NE(lonely.output().find("needs --redis HOST:PORT"), std::string::npos)
        << lonely.output();
    redis.command({"SET", "raybundle:{box}:scene", "another"});
    Daemon wrong(Daemon::Unready{},
                 Daemon::Command{{"work", scene, "--redis", redis.text(), "--project", "box"}});
    EXPECT_EQ(wrong.wait(), 1);
    EXPECT_NE(wrong.output().find("has another scene file"), std::string::npos) << wrong.output();
}

}  // namespace
}  // namespace raybundle::worker_test
