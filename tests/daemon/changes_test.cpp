// SPDX-License-Identifier: Apache-2.0
// Changes that come faster than they can be worked in pass special phases together.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"

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

/// The same once a number of slices has been reached and no more come; waits up to a minute.
Phases phases_at_rest(std::uint16_t port, int least_slices) {
    Phases last;
    int same = 0;
    for (int i = 0; i < 240 && same < 3; ++i) {
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

}  // namespace
}  // namespace raybundle
