// SPDX-License-Identifier: Apache-2.0
// Luminaires that are added, exchanged and removed while the solution is there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "changed_room.h"
#include "growing_room.h"
#include "scene/edit/light_edit.h"
#include "scene/scene_folder.h"

namespace raybundle::added_lights_test {
namespace {

constexpr std::uint32_t point_light = 1;  // of the room's file
constexpr std::uint64_t iterations = 512;

class AddedLights : public testing::TestWithParam<bool> {
  protected:
    AddedLights() : room(furnished()) {}

    SceneBuilder furnished() {
        SceneBuilder b = room_to_furnish(GetParam());
        b.scene.folder = files.open();
        return b;
    }

    PhotometryFolder files;
    GrowingRoom room;
};

TEST_P(AddedLights, EndWhereAFreshSolveOfTheChangedSceneDoes) {
    room.iterate(200);
    const std::uint32_t first = room.add_light("wide.ies", {1.2F, 2.0F, 2.0F});
    EXPECT_EQ(first, first_added_light);
    EXPECT_EQ(room.planned_anew, 1U);  // no luminaire had been there
    room.iterate(iterations);
    room.expect_fresh(iterations, "the first luminaire");
    const std::uint32_t second = room.add_light("narrow.ies", {4.0F, 2.5F, 1.0F});
    EXPECT_EQ(second, first + 1);
    EXPECT_EQ(room.planned_anew, 1U);
    room.iterate(64);
    room.set_photometry(first, "narrow.ies");
    room.iterate(iterations);
    room.expect_fresh(iterations, "another one, and the first exchanged");
    room.remove_light(second);
    room.remove_light(point_light);
    EXPECT_EQ(room.planned_anew, 1U);
    room.iterate(iterations);
    room.expect_fresh(iterations, "one of them and a light of the file removed");
}

TEST_P(AddedLights, ThereAndBackKeepTheFirstLight) {
    room.iterate(iterations);
    const auto before = room.light();
    const auto direct = room.solver->store().first_shot()->read_irradiance();
    const std::uint32_t light = room.add_light("wide.ies", {1.2F, 2.0F, 2.0F});
    room.remove_light(light);
    room.remove_light(point_light);
    room.remove_light(point_light, false);
    const auto shot = room.solver->store().first_shot()->read_irradiance();
    for (std::size_t i = 0; i < shot.size(); ++i) {
        ASSERT_NEAR(shot[i].g, direct[i].g, 1e-4F * direct[i].g + 1e-6F);
    }
    room.iterate(iterations);
    const auto [level, difference] = compared(room.light(), before);
    EXPECT_NEAR(level, 1.0, 0.021);
    EXPECT_LT(difference, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Rooms, AddedLights, testing::Values(false), room_name);
INSTANTIATE_TEST_SUITE_P(HeavyRooms, AddedLights, testing::Values(true), room_name);

/// So many luminaires come, four at a time, and go.
void expect_no_drift(std::size_t count) {
    const PhotometryFolder files;
    SceneBuilder b = room_to_furnish(false);
    b.scene.folder = files.open();
    GrowingRoom room(std::move(b));
    room.iterate(iterations);
    const auto before = room.light();
    const auto direct = room.solver->store().first_shot()->read_irradiance();
    std::vector<std::uint32_t> lights;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 place(0.5F + 0.25F * static_cast<float>(i % 20), 2.5F,
                              0.5F + 0.3F * static_cast<float>(i / 20));
        lights.push_back(room.add_light(i % 2 == 0 ? "wide.ies" : "narrow.ies", place));
        if (i >= 4) {
            room.remove_light(lights[i - 4]);
        }
    }
    for (std::size_t i = count - 4; i < count; ++i) {
        room.remove_light(lights[i]);
    }
    EXPECT_LE(room.planned_anew, 2U);
    EXPECT_EQ(added_lights(room.b.scene), count);  // the removed keep their numbers
    const auto unit = room.solver->scene().radiance_unit();
    const auto after = room.solver->store().first_shot()->read_irradiance();
    double largest = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        largest = std::max(largest, std::abs(double{after[i].g} - double{direct[i].g}));
        sum += double{direct[i].g} / static_cast<double>(after.size());
    }
    EXPECT_GT(unit, 0.0F);
    EXPECT_LT(largest, 1e-4 * sum);
    room.iterate(iterations);
    const auto [level, difference] = compared(room.light(), before);
    EXPECT_NEAR(level, 1.0, 0.021);
    EXPECT_LT(difference, 0.05);
}

TEST(AddedLuminaires, TwelveThatComeAndGoLeaveNoDrift) {
    expect_no_drift(12);
}

TEST(HeavyAddedLuminaires, TwoHundredThatComeAndGoLeaveNoDrift) {
    expect_no_drift(200);
}

TEST(AddedLuminaires, EachRefusalSaysWhyAndChangesNothing) {
    const PhotometryFolder files;
    Scene scene = room_to_furnish(true).scene;
    AddedLuminaire luminaire;
    luminaire.photometry = "wide.ies";
    EXPECT_NE(problem_of(scene, luminaire).find("no folder"), std::string::npos);
    scene.folder = files.open();
    EXPECT_EQ(problem_of(scene, luminaire), "");
    luminaire.photometry = "absent.ies";
    EXPECT_NE(problem_of(scene, luminaire).find("no such photometric file"), std::string::npos);
    luminaire.photometry = "../wide.ies";
    EXPECT_NE(problem_of(scene, luminaire), "");
    luminaire.photometry = "wide.ies";
    luminaire.position.x = 1e8F;
    EXPECT_NE(problem_of(scene, luminaire).find("position"), std::string::npos);
    EXPECT_NE(removal_problem(scene, 7), "");
    EXPECT_EQ(removal_problem(scene, point_light), "");
    set_light_removed(scene, point_light, true);
    EXPECT_NE(removal_problem(scene, point_light), "");
    EXPECT_EQ(light_numbers(scene), std::vector<std::uint32_t>());
}

}  // namespace
}  // namespace raybundle::added_lights_test
