// SPDX-License-Identifier: Apache-2.0
// Objects that are removed and copied while the solution is there.
#include <gtest/gtest.h>

#include <cmath>

#include "../reference/lit_room.h"
#include "changed_room.h"
#include "growing_room.h"
#include "scene/edit/light_edit.h"

namespace raybundle::added_objects_test {
namespace {

constexpr std::uint32_t box = 1;  // object
constexpr std::uint64_t iterations = 512;

class AddedObjects : public testing::TestWithParam<bool> {
  protected:
    AddedObjects() : room(room_to_furnish(GetParam())) {}

    GrowingRoom room;
};

TEST_P(AddedObjects, ThatAreRemovedAndComeBackEndWhereAFreshSolveDoes) {
    room.iterate(200);
    room.remove_object(box);
    room.iterate(iterations);
    room.expect_fresh(iterations, "removed");
    room.remove_object(box, false);
    room.iterate(iterations);
    room.expect_fresh(iterations, "there again");
}

TEST_P(AddedObjects, ACopyEndsWhereAFreshSolveOfTheSceneWithItDoes) {
    room.iterate(iterations);
    const auto before = room.light();
    const std::size_t fronts = room.b.mesh.front_patch_count();
    const std::uint32_t copy = room.grow(box, {2.5F, 0.0F, 0.5F});
    const auto grown = room.light();
    ASSERT_GT(grown.size(), before.size());
    for (std::size_t i = 0; i < fronts; ++i) {
        ASSERT_NEAR(grown[i].g, before[i].g, 1e-4F * before[i].g + 1e-6F) << i;
    }
    room.remove_object(copy, false);
    room.iterate(iterations);
    room.expect_fresh(iterations, "with a copy");
    room.remove_object(copy);
    room.iterate(iterations);
    room.expect_fresh(iterations, "without it again");
    const auto [level, difference] = compared(room.light(), before);
    EXPECT_NEAR(level, 1.0, 0.021);
    EXPECT_LT(difference, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Rooms, AddedObjects, testing::Values(false), room_name);
INSTANTIATE_TEST_SUITE_P(HeavyRooms, AddedObjects, testing::Values(true), room_name);

enum class SingleRays { mirror, air };

constexpr std::uint64_t few_iterations = 192;  // where levels alone are compared

/// A room some of whose light comes by single rays: from a mirror that hangs before a wall, or out
/// of the air.
SceneBuilder room_of(SingleRays kind) {
    SceneBuilder b = room_to_furnish(false);
    if (kind == SingleRays::air) {
        b.scene.medium = Medium{.extinction = Medium::extinction_of(6.0)};
        return b;
    }
    Material mirror;
    mirror.base_colour = glm::vec3(0.95F);
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    const auto material = b.add_material(mirror);
    b.add_object("mirror");
    b.add_quad({5.98F, 0.2F, 0.3F}, {0, 0, 3.4F}, {0, 2.6F, 0}, 4, 4, material);
    return b;
}

class LightOfSingleRays : public testing::TestWithParam<SingleRays> {};

TEST_P(LightOfSingleRays, StaysWhileTheSceneGrows) {
    GrowingRoom room(room_of(GetParam()));
    room.iterate(few_iterations);
    const auto before = room.light();
    const std::size_t fronts = room.b.mesh.front_patch_count();
    room.grow(box, {2.5F, 0.0F, 0.5F});
    const auto grown = room.light();
    for (std::size_t i = 0; i < fronts; ++i) {
        ASSERT_NEAR(grown[i].g, before[i].g, 1e-3F * before[i].g + 1e-6F) << i;
    }
}

/// 64 iterations after a copy has come, levels of eight rooms scattered with a standard deviation
/// of 3 % at most (right after it 3.9 % with the mirror, 6 % with air), those of solves of 1024
/// iterations with 1 %: three of those of the mean of four beside one such.
TEST_P(LightOfSingleRays, IsThatOfAFreshSolveOnceACopyHasCome) {
    double sum = 0.0;
    std::vector<glm::vec4> truth;
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
        GrowingRoom room(room_of(GetParam()), seed);
        room.iterate(few_iterations);
        const std::uint32_t copy = room.grow(box, {2.5F, 0.0F, 0.5F});
        room.remove_object(copy, false);
        room.iterate(64);
        if (truth.empty()) {
            GrowingRoom fresh(room.b, 77);
            fresh.iterate(1024);
            truth = fresh.light();
        }
        sum += compared(room.light(), truth).first;
    }
    EXPECT_NEAR(sum / 4.0, 1.0, 0.054);
}

INSTANTIATE_TEST_SUITE_P(Rooms, LightOfSingleRays,
                         testing::Values(SingleRays::mirror, SingleRays::air),
                         [](const auto& room) {
                             return room.param == SingleRays::air ? "Air" : "Mirror";
                         });

/// A luminaire that is dimmed to nothing changes no light, whatever shaders its slot calls for.
TEST(LightOfTheAir, StaysWhileShadersArePlannedAnew) {
    GrowingRoom room(room_of(SingleRays::air));
    room.iterate(few_iterations);
    const PhotometryFolder files;
    room.b.scene.folder = files.open();
    const auto before = room.light();
    AddedLuminaire luminaire;
    luminaire.number = next_luminaire(room.b.scene);
    luminaire.photometry = "wide.ies";
    luminaire.position = {2.0F, 2.0F, 1.0F};
    luminaire.aim = {0.0F, -1.0F, 0.0F};
    add_luminaire(room.b.scene, luminaire);
    LightEdit dark;
    dark.light = luminaire.number;
    dark.dim = 0.0F;
    apply(room.b.scene, dark);
    room.change_lights();
    ASSERT_EQ(room.planned_anew, 1U);
    EXPECT_NEAR(compared(room.light(), before).first, 1.0, 0.04);
}

/// Of the only lamp of a closed room nothing is left, and it comes back as bright as it was.
TEST(RemovedObjects, TakeTheirLightAlong) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_box({0, 0, 0}, {5, 3, 4}, true, 5, wall);
    b.add_object("lamp");
    b.add_box({2.0F, 2.5F, 1.5F}, {2.6F, 2.7F, 2.1F}, false, 2, lamp);
    GrowingRoom room(std::move(b));
    room.iterate(iterations);
    const auto before = room.light();
    room.remove_object(1);
    room.iterate(iterations);
    const auto dark = room.light();
    const auto [rest, apart] = compared(dark, before);
    EXPECT_LT(rest, 0.02);
    room.remove_object(1, false);
    room.iterate(iterations);
    room.expect_fresh(iterations, "the lamp is there again");
}

/// A lamp without extent goes and comes with what carries it.
TEST(RemovedObjects, TakeTheLightsThatTheyCarryAlong) {
    SceneBuilder b = room_to_furnish(false);
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {1.5F, 1.4F, 1.9F}, {0, -1, 0},
                       glm::vec3(40.0F));
    b.scene.punctual_lights.back().object = static_cast<int>(box);
    GrowingRoom room(std::move(b));
    room.iterate(200);
    room.remove_object(box);
    room.iterate(iterations);
    room.expect_fresh(iterations, "the box and its lamp removed");
    room.remove_object(box, false);
    room.iterate(iterations);
    room.expect_fresh(iterations, "both there again");
}

/// Patches of several triangles, two-sided ones, and facets keep what they are in a copy.
TEST(GrownMesh, HasThePatchesOfWhatItIsACopyOf) {
    SceneBuilder b;
    Material sheet;
    sheet.double_sided = true;
    sheet.specular = 0.0F;
    const auto both = b.add_material(sheet);
    const auto wall = b.add_material(glm::vec3(0.5F));
    b.add_quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}, 4, 4, both);
    b.add_object("thing");
    b.add_box({1, 0, 1}, {2, 1, 2}, false, 2, wall);
    b.add_quad({1, 2, 1}, {0, 0, 1}, {1, 0, 0}, 2, 2, both);
    b.join(4);
    Scene scene = b.scene;
    PatchMesh mesh = b.mesh;
    const PatchMesh thing = part_of(mesh, 1);
    AddedObject added;
    added.copy_of = 2;
    added.name = "another";
    add_object(scene, mesh, added);
    const PatchMesh copy = part_of(mesh, 2);
    EXPECT_EQ(scene.objects[2].name, "another");
    EXPECT_TRUE(scene.objects[2].removed);
    EXPECT_EQ(copy.triangle_count(), thing.triangle_count());
    EXPECT_EQ(copy.side_count(), thing.side_count());
    EXPECT_EQ(copy.patch_count(), thing.patch_count());
    EXPECT_EQ(copy.front_patch_count(), thing.front_patch_count());
    EXPECT_EQ(copy.facets.size(), thing.facets.size());
    EXPECT_EQ(mesh.patch_count(), b.mesh.patch_count() + thing.patch_count());
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        const std::uint32_t triangle = mesh.side_triangle[side];
        EXPECT_TRUE(side == triangle || mesh.back_side[triangle] == side);
    }
    for (std::uint32_t patch = 0; patch < b.mesh.front_patch_count(); ++patch) {
        EXPECT_EQ(mesh.triangle_of(patch), b.mesh.triangle_of(patch));
    }
    for (std::uint32_t patch = 0; patch < thing.patch_count(); ++patch) {
        EXPECT_EQ(copy.sides_of(patch).size(), thing.sides_of(patch).size());
    }
    take_back(scene, mark_growth(b.scene));
    EXPECT_EQ(scene.objects.size(), b.scene.objects.size());
}

}  // namespace
}  // namespace raybundle::added_objects_test
