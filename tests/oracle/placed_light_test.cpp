// SPDX-License-Identifier: Apache-2.0
// Lights without extent that are carried, aimed and dimmed while the solution is there, against
// fresh solves of the changed scene.
#include <gtest/gtest.h>

#include <memory>

#include "../reference/lit_room.h"
#include "changed_room.h"

namespace raybundle::placed_light_test {
namespace {

/// A closed room with a lamp of this kind on its left (light 1) and a weak one on its right.
SceneBuilder room_with(PunctualKind kind, bool luminaire) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {6, 3, 4}, true, 5, b.add_material(glm::vec3(0.6F, 0.5F, 0.4F)));
    b.add_box({2.6F, 0, 1.4F}, {3.2F, 1.4F, 2.2F}, false, 3, b.add_material(glm::vec3(0.4F)));
    add_punctual_light(b, glm::mat4(1.0F), kind, {1.2F, 2.0F, 2.0F}, {0.1F, -1.0F, 0.2F},
                       glm::vec3(luminaire ? 2.0F : 150.0F));
    if (luminaire) {
        b.scene.punctual_lights.back().profile = std::make_shared<const IesProfile>(
            parse_ies("lopsided.ies",
                      "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 3 1 2 0 0 0\n1 1 10\n0 45 90\n"
                      "0 90 180\n100 80 40\n100 60 20\n100 30 0\n"));
    }
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {4.8F, 2.0F, 2.0F}, {0, -1, 0},
                       {10.0F, 12.0F, 11.0F});
    return b;
}

LightEdit edit_of_first() {
    LightEdit edit;
    edit.light = 1;
    return edit;
}

struct Case {
    const char* name;
    PunctualKind kind;
    bool luminaire;
};

class PlacedLights : public testing::TestWithParam<Case> {};

TEST_P(PlacedLights, EndWhereAFreshSolveOfTheChangedSceneDoes) {
    constexpr std::uint64_t iterations = 384;
    Solved room(room_with(GetParam().kind, GetParam().luminaire));
    room.iterate(200);
    LightEdit carried = edit_of_first();  // behind the block
    carried.position = glm::vec3(4.6F, 1.6F, 1.0F);
    room.change(carried);
    room.iterate(iterations);
    expect_fresh(room, iterations, "carried across the room");
    LightEdit aimed = edit_of_first();
    aimed.aim = glm::vec3(-1.0F, -0.2F, 0.3F);
    aimed.rotation = 60.0F;
    room.change(aimed);
    room.iterate(iterations);
    expect_fresh(room, iterations, "aimed at a wall");
}

TEST_P(PlacedLights, ThereAndBackKeepsTheFirstLight) {
    Solved room(room_with(GetParam().kind, GetParam().luminaire));
    room.iterate(400);
    const auto before = room.solver.store().read_irradiance();
    const glm::vec3 home = room.b.scene.punctual_lights[0].position;
    for (const glm::vec3& place : {home + glm::vec3(0.4F, 0.0F, 0.0F), home}) {
        LightEdit edit = edit_of_first();
        edit.position = place;
        room.change(edit);
        room.iterate(64);
    }
    room.iterate(256);
    const auto [level, difference] = compared(room.solver.store().read_irradiance(), before);
    EXPECT_NEAR(level, 1.0, 0.01);
    EXPECT_LT(difference, 0.04);
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Cases, PlacedLights,
                         testing::Values(Case{"Point", PunctualKind::point, false},
                                         Case{"Spot", PunctualKind::spot, false},
                                         Case{"Luminaire", PunctualKind::point, true}),
                         case_name);

/// Dimming the only lights alike is linear: nothing is solved anew, and full light comes back to
/// the bit of its float.
TEST(PlacedLight, DimmingAllIsLinear) {
    Solved room(room_with(PunctualKind::point, false));
    room.iterate(64);
    const auto before = room.solver.store().read_irradiance();
    for (const float dim : {0.25F, 1.0F}) {
        for (std::uint32_t light = 1; light <= 2; ++light) {
            LightEdit edit;
            edit.light = light;
            edit.dim = dim;
            apply(room.b.scene, edit);
        }
        LightEdit none = edit_of_first();
        none.group = "all";
        room.change(none);
        const auto after = room.solver.store().read_irradiance();
        for (std::size_t i = 0; i < before.size(); ++i) {
            ASSERT_NEAR(after[i].g, dim * before[i].g, 1e-5F * before[i].g);
        }
    }
}

}  // namespace
}  // namespace raybundle::placed_light_test
