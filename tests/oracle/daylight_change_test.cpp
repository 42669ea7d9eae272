// SPDX-License-Identifier: Apache-2.0
// Sky and sun that go on by the clock while the solution is there, against fresh solves of the
// changed scene.
#include <gtest/gtest.h>

#include "../reference/lit_room.h"
#include "changed_room.h"
#include "scene/edit/daylight_edit.h"

namespace raybundle::daylight_change_test {
namespace {

DaylightSetting daylight(const std::string& sky, float elevation, float azimuth) {
    DaylightSetting setting;
    setting.sky = sky;
    setting.sun_elevation = elevation;
    setting.sun_azimuth = azimuth;
    return setting;
}

/// A room whose front (-z, north) is open, with a lamp (light 1).
SceneBuilder open_room() {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    b.add_quad({0, 0, 0}, {0, 0, 4}, {6, 0, 0}, 6, 6, wall);
    b.add_quad({0, 3, 0}, {6, 0, 0}, {0, 0, 4}, 6, 6, wall);
    b.add_quad({0, 0, 4}, {0, 3, 0}, {6, 0, 0}, 6, 6, wall);
    b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 4}, 6, 6, wall);
    b.add_quad({6, 0, 0}, {0, 0, 4}, {0, 3, 0}, 6, 6, wall);
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {3.0F, 2.0F, 3.0F}, {0, -1, 0},
                       glm::vec3(100.0F));
    return b;
}

void go_on(Solved& room, const DaylightSetting& setting) {
    apply(room.b.scene, setting);
    ASSERT_TRUE(room.solver.covers_lights(room.b.scene));
    LightEdit lamp;  // as it is
    lamp.light = 1;
    lamp.on = true;
    room.change(lamp);
}

TEST(DaylightChange, EndsWhereAFreshSolveOfTheLaterDayDoes) {
    constexpr std::uint64_t iterations = 512;
    SceneBuilder b = open_room();
    apply(b.scene, daylight("clear", 25.0F, 20.0F));
    Solved room(std::move(b));
    room.iterate(200);
    go_on(room, daylight("clear", 50.0F, -40.0F));
    room.iterate(iterations);
    expect_fresh(room, iterations, "later");
    go_on(room, daylight("overcast", 50.0F, -40.0F));
    room.iterate(iterations);
    expect_fresh(room, iterations, "clouds");
}

/// By night the lamp is left, exactly as without a sky, whatever shone before.
TEST(DaylightChange, NightLeavesTheLampAlone) {
    constexpr std::uint64_t iterations = 256;
    SceneBuilder b = open_room();
    apply(b.scene, daylight("clear", 40.0F, 0.0F));
    Solved room(std::move(b));
    room.iterate(200);
    go_on(room, daylight("clear", -5.0F, 0.0F));
    room.iterate(iterations);
    expect_fresh(room, iterations, "night");
}

/// A scene that was opened without a sky: another solver takes over, and the floor before the room
/// has the illuminance of the sky and the sun.
TEST(DaylightChange, ASolverThatKnowsNoSkyIsTakenOver) {
    Solved room(open_room());
    room.iterate(64);
    apply(room.b.scene, daylight("clear", 50.0F, -40.0F));
    ASSERT_FALSE(room.solver.covers_lights(room.b.scene));
    Solver next(room.b.scene, room.b.mesh, SolverSettings{});
    next.take_over(room.solver, {}, {});
    const auto advance = [](Solver& solver, int count) {
        for (int i = 0; i < count || solver.correcting(); ++i) {
            solver.step({});
        }
    };
    advance(next, 512);
    Solver fresh(room.b.scene, room.b.mesh, SolverSettings{});
    advance(fresh, 512);
    const auto [level, difference] =
        compared(next.store().read_irradiance(), fresh.store().read_irradiance());
    EXPECT_NEAR(level, 1.0, 0.015);
    EXPECT_LT(difference, 0.04);
}

}  // namespace
}  // namespace raybundle::daylight_change_test
