// SPDX-License-Identifier: Apache-2.0
// A server that is killed again and again while a viewer changes things as fast as it is answered.
// Long, so label heavy.
#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"
#include "test_folder.h"

namespace raybundle {
namespace {

constexpr int kRounds = 15;

/// What the viewer has been told is so.
struct Acknowledged {
    std::uint32_t epoch = 0;
    double box_x = 0.0;
    double intensity = 0.0;
    std::size_t pins = 0;
    double target = 0.0;  ///< seconds; 0: none
};

const Json& named(const Json& list, const std::string& key, const Json& value) {
    for (const Json& item : list) {
        if (item.at(key) == value) {
            return item;
        }
    }
    throw std::runtime_error("no such entry: " + value.dump());
}

/// A restarted server has at least that, and where no change came after it, just that.
void expect_kept(const Json& welcome, const Acknowledged& known) {
    const auto epoch = welcome.at("epoch").get<std::uint32_t>();
    EXPECT_GE(epoch, known.epoch);
    EXPECT_LE(epoch, known.epoch + 1) << "one request at a time was under way";
    EXPECT_GE(welcome.at("pins").size(), known.pins);
    EXPECT_LE(welcome.at("pins").size(), known.pins + 1);
    if (epoch != known.epoch || epoch == 0) {
        return;
    }
    const Json& scene = welcome.at("scene");
    const Json& box = named(scene.at("objects"), "id", kShortBox);
    EXPECT_NEAR(box.at("transform").at("translation").at("x").get<double>(), known.box_x, 1e-5);
    const double intensity = scene.at("lights").at(0).at("intensity").get<double>();
    EXPECT_NEAR(intensity, known.intensity, 1e-3);
}

/// Changes one thing after the other until the server is gone.
void change_until_killed(JsonViewer& viewer, Acknowledged& known) {
    for (int i = 0;; ++i) {
        const double x = 1.5 + 0.01 * (i % 100);
        const Json requests[] = {
            {{"moveObject",
              {{"object", kShortBox},
               {"transform", {{"translation", {{"x", x}, {"y", 0.825}, {"z", 1.7}}}}}}}},
            {{"setLight", {{"light", 1}, {"intensity", 500.0 + i}}}},
            {{"addPin", {{"text", "a"}, {"position", {{"x", 1.0}, {"y", 0.0}, {"z", 1.0}}}}}},
            {{"setTarget", {{"seconds", 10.0 + i}}}}};
        for (const Json& request : requests) {
            const Json answer = viewer.request(request);
            if (answer.contains("sceneChanged")) {
                known.epoch = answer.at("sceneChanged").at("epoch").get<std::uint32_t>();
                (request.contains("moveObject") ? known.box_x : known.intensity) =
                    request.contains("moveObject") ? x : 500.0 + i;
            } else if (answer.contains("pinChanged")) {
                ++known.pins;
            } else if (answer.contains("ok")) {
                known.target = 10.0 + i;
            } else {
                return;
            }
        }
    }
}

TEST(KilledHeavy, AtAnyMomentNothingAcknowledgedIsLost) {
    const TestFolder folder;
    std::mt19937 random(7);
    std::uniform_int_distribution<int> delay_ms(0, 1500);
    Acknowledged known;
    for (int round = 0; round < kRounds; ++round) {
        Daemon daemon(scene_file("cornell_box.gltf"), {"--journal", folder.path("session.db")});
        JsonViewer viewer(daemon.port());
        const Json answer = viewer.join();
        ASSERT_TRUE(answer.contains("welcome")) << answer.dump() << daemon.output();
        const Json& welcome = answer.at("welcome");
        expect_kept(welcome, known);
        // What was under way has been done or not.
        known.epoch = welcome.at("epoch").get<std::uint32_t>();
        known.pins = welcome.at("pins").size();
        known.box_x = named(welcome.at("scene").at("objects"), "id", kShortBox)
                          .at("transform")
                          .at("translation")
                          .at("x")
                          .get<double>();
        known.intensity = welcome.at("scene").at("lights").at(0).at("intensity").get<double>();
        if (known.target > 0.0) {
            const Json solution = viewer.next([](const Json& message) {
                return message.contains("solution") &&
                       message.at("solution").contains("secondsToTarget");
            });
            EXPECT_FALSE(solution.empty()) << "the target of its name is forgotten";
        }
        std::thread killer([process = daemon.process(), ms = delay_ms(random)] {
            std::this_thread::sleep_for(std::chrono::milliseconds(ms));
            kill(process, SIGKILL);
        });
        try {
            change_until_killed(viewer, known);
        } catch (const std::exception&) {
            // The connection broke while something was sent.
        }
        killer.join();  // before the process is waited for and its number means another one
        EXPECT_EQ(daemon.wait(), -SIGKILL);
        EXPECT_EQ(daemon.output().find("damaged"), std::string::npos) << daemon.output();
    }
    EXPECT_GE(known.epoch, static_cast<std::uint32_t>(kRounds)) << "hardly anything was changed";
}

}  // namespace
}  // namespace raybundle
