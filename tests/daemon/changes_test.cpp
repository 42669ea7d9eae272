// SPDX-License-Identifier: Apache-2.0
// Changes that come faster than they can be worked in pass special phases together.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stop_token>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"
#include "test_folder.h"

namespace raybundle {
namespace {

constexpr int bundles = 8;             // of one phase, at least; a second object asks for half more
constexpr std::uint32_t first_id = 1;  // id of a burst's first request

/// What the daemon has counted so far.
struct Phases {
    int begun = 0;
    int slices = 0;
    bool operator==(const Phases&) const = default;
};

int counted(const std::string& metrics, const std::string& name) {
    const std::size_t found = metrics.find("\n" + name + " ");
    return found == std::string::npos ? -1 : std::stoi(metrics.substr(found + name.size() + 2));
}

Phases phases(std::uint16_t port) {
    const std::string text =
        http_exchange(port, "GET /metrics HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
    return {counted(text, "raybundle_special_phases_total"),
            counted(text, "raybundle_iteration_seconds_count{strategy=\"special\"}")};
}

/// The same once a number of slices has been reached and no more come; only what hangs takes so
/// long as is waited.
Phases phases_at_rest(std::uint16_t port, int least_slices) {
    Phases last;
    int same = 0;
    for (int i = 0; i < 2400 && same < 3; ++i) {
        const Phases now = phases(port);
        same = now.slices >= least_slices && now == last ? same + 1 : 0;
        last = now;
        std::this_thread::sleep_for(std::chrono::milliseconds(250));
    }
    return last;
}

Json moved(int object, double x, double y, double z) {
    return {
        {"moveObject",
         {{"object", object}, {"transform", {{"translation", {{"x", x}, {"y", y}, {"z", z}}}}}}}};
}

Json painted(int material, double red) {
    return {{"setMaterial",
             {{"material", material}, {"baseColour", {{"x", red}, {"y", 0.2}, {"z", 0.1}}}}}};
}

class ChangesTest : public testing::Test {
  protected:
    ChangesTest() { viewer_.join(); }

    /// Sends three changes at once; the phases that they have taken. The first may begin before
    /// the others are read; these then wait behind it.
    Phases work_in(std::array<Json, 3> burst) {
        const Phases before = phases(daemon_.port());
        for (std::uint32_t i = 0; i < burst.size(); ++i) {
            burst.at(i)["id"] = first_id + i;
            viewer_.send(burst.at(i));
        }
        for (std::uint32_t i = 0; i < burst.size(); ++i) {
            EXPECT_TRUE(viewer_.answer_to(first_id + i).contains("sceneChanged")) << i;
        }
        const Phases after = phases_at_rest(daemon_.port(), before.slices + bundles);
        return {after.begun - before.begun, after.slices - before.slices};
    }

    Daemon daemon_{scene_file("cornell_box.gltf")};
    JsonViewer viewer_{daemon_.port()};
};

TEST_F(ChangesTest, WhatWaitsTogetherPassesOnePhase) {
    const Phases moves =
        work_in({moved(2, 2.0, 0.825, 1.7), moved(2, 2.4, 0.825, 1.7), moved(3, 3.4, 1.65, 3.6)});
    EXPECT_GE(moves.begun, 1);
    EXPECT_LE(moves.begun, 2);
    EXPECT_GE(moves.slices, bundles + bundles / 2);  // both boxes at once
    const Json dimmed = {{"setLight", {{"light", 1}, {"intensity", 500.0}}}};
    const Phases surfaces = work_in({painted(1, 0.3), painted(2, 0.6), dimmed});
    EXPECT_GE(surfaces.begun, 1);
    EXPECT_LE(surfaces.begun, 2);
    EXPECT_GE(surfaces.slices, bundles);
}

/// A viewer that drags an object as fast as it may, on a thread of its own: the next step is on its
/// way before the last one is answered.
class Dragger {
  public:
    static constexpr int most_steps = 300;

    Dragger(std::uint16_t port, int object)
        : viewer_(port), thread_([this, object](const std::stop_token& stop) {
              viewer_.join();
              for (int step = 1; step <= most_steps && !stop.stop_requested(); ++step) {
                  const double to_and_fro = step % 2 == 0 ? 0.05 : 0.0;
                  Json move = moved(object, 2.0 + to_and_fro, 0.825, 1.7);
                  move["moveObject"]["final"] = false;
                  move["id"] = step;
                  viewer_.send(move);
                  if (step > 1) {
                      viewer_.answer_to(static_cast<std::uint32_t>(step - 1));
                  }
              }
              done_ = true;
          }) {}

    [[nodiscard]] bool done() const { return done_; }

  private:
    JsonViewer viewer_;
    std::atomic<bool> done_{false};
    std::jthread thread_;
};

/// Iterations so far, those of special phases left out.
int iterations(std::uint16_t port) {
    const std::string text =
        http_exchange(port, "GET /metrics HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
    return counted(text, "raybundle_iteration_seconds_count{strategy=\"perspective\"}") +
           counted(text, "raybundle_iteration_seconds_count{strategy=\"layered\"}");
}

TEST_F(ChangesTest, WhoDragsLeavesFramesAndIterationsToEverybody) {
    constexpr int few = 6;  // of the changes that two draggers make
    JsonViewer second(daemon_.port());
    second.join();
    for (JsonViewer* const watcher : {&viewer_, &second}) {
        ASSERT_FALSE(watcher->next_frame([](const Json&) { return true; }).empty());
    }
    const int phases_before = phases(daemon_.port()).begun;
    const int iterations_before = iterations(daemon_.port());
    Dragger short_box(daemon_.port(), 2);
    Dragger tall_box(daemon_.port(), 3);
    for (JsonViewer* const watcher : {&viewer_, &second}) {
        int frames = 0;
        int shown = 0;
        while (frames < few && !(short_box.done() && tall_box.done())) {
            const Json header = watcher->next_frame([](const Json&) { return true; });
            ASSERT_FALSE(header.empty());
            frames += header.value("epoch", 0) > shown ? 1 : 0;
            shown = header.value("epoch", 0);
        }
        EXPECT_EQ(frames, few) << "of " << shown << " changes";
    }
    const int begun = phases(daemon_.port()).begun - phases_before;
    // The last one has not ended, and the first had none to wait for.
    EXPECT_GE(iterations(daemon_.port()) - iterations_before, begun - 2);
}

/// The room of effects/polished.gltf, where nothing is smooth but a metal floor that sends so much
/// light, cd/m².
std::string scene_with_metal_floor(double emission) {
    std::ifstream file(scene_file("effects/polished.gltf"));
    Json scene = Json::parse(file);
    for (Json& material : scene.at("materials")) {
        material["pbrMetallicRoughness"]["roughnessFactor"] = 1.0;
        if (material.at("name") == "stone") {
            material["pbrMetallicRoughness"]["roughnessFactor"] = 0.0;
            material["pbrMetallicRoughness"]["metallicFactor"] = 1.0;
            material["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1.0};
            material["emissiveFactor"] = {1.0, 1.0, 1.0};
            material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] =
                emission;
        }
    }
    return scene.dump();
}

void wait_for_iterations(JsonViewer& viewer, int count) {
    const Json first = viewer.next_frame([](const Json&) { return true; });
    ASSERT_FALSE(viewer
                     .next_frame([&](const Json& header) {
                         return header.value("iterations", 0) >
                                first.value("iterations", 0) + count;
                     })
                     .empty());
}

/// cd/m² that a grid of pixels of the lower half of a picture of 160x120 shows.
std::vector<double> floor_luminance(JsonViewer& viewer) {
    std::vector<double> shown;
    for (int y = 80; y < 120; y += 12) {
        for (int x = 8; x < 160; x += 16) {
            const Json answer = viewer.request({{"probe", {{"pixel", {{"x", x}, {"y", y}}}}}});
            shown.push_back(answer.at("probeResult").value("luminance", 0.0));
        }
    }
    return shown;
}

TEST(HeavyPolishedLamp, ThatIsPutOutIsTheMirrorThatItWouldBe) {
    const TestFolder folder;
    folder.write("lamp.gltf", scene_with_metal_floor(50.0));
    folder.write("mirror.gltf", scene_with_metal_floor(0.0));
    std::vector<double> put_out;
    {
        const Daemon daemon(folder.path("lamp.gltf"));
        JsonViewer viewer(daemon.port());
        const Json welcome = viewer.join().at("welcome");
        Json off;
        for (const Json& light : welcome.at("scene").at("lights")) {
            if (light.value("name", "") == "stone") {
                off = {{"setLight", {{"light", light.at("id")}, {"on", false}}}};
            }
        }
        ASSERT_FALSE(off.empty()) << welcome.dump();
        wait_for_iterations(viewer, 16);
        ASSERT_TRUE(viewer.request(off).contains("sceneChanged"));
        wait_for_iterations(viewer, 192);
        put_out = floor_luminance(viewer);
    }
    const Daemon daemon(folder.path("mirror.gltf"));
    JsonViewer viewer(daemon.port());
    viewer.join();
    wait_for_iterations(viewer, 192);
    const std::vector<double> never_lit = floor_luminance(viewer);
    double difference = 0.0;
    double light = 0.0;
    for (std::size_t i = 0; i < put_out.size(); ++i) {
        difference += (put_out[i] - never_lit[i]) * (put_out[i] - never_lit[i]);
        light += never_lit[i] * never_lit[i];
    }
    EXPECT_GT(light, 0.0);
    EXPECT_LE(std::sqrt(difference / light),
              0.3);  // 0.55 where it stays as rough as bundles know it
}

}  // namespace
}  // namespace raybundle
