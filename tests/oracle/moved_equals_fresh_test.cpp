// SPDX-License-Identifier: Apache-2.0
// numerics.md, "Object passes through a wall, leaves the scene, is scaled to 0" and "Light carried
// by the moved object": after such moves the solution converges to that of fresh solves.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fresh_solves.h"
#include "moved_box.h"

namespace raybundle::moved_equals_fresh_test {
namespace {

#ifdef RAYBUNDLE_LONG_TESTS
constexpr int solves = 8;
constexpr std::uint64_t iterations_at_rest = 768;
constexpr bool all_cases = true;
#else
constexpr int solves = 3;
constexpr std::uint64_t iterations_at_rest = 160;
constexpr bool all_cases = false;
#endif

SolverSettings quick(std::uint64_t seed) {
    SolverSettings settings = quick_settings(seed, {48, 64});
    settings.special = interactive_special();
    return settings;
}

Transform at(const glm::vec3& place, float scale = 1.0F) {
    Transform transform;
    transform.translation = place;
    transform.scale = glm::vec3(scale);
    return transform;
}

/// Places of a box (object 1), a box with a lamp under it (object 2), and a smaller box (object 3).
using Places = std::vector<Transform>;

SceneBuilder room(const Places& places) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(900.0F, 1000.0F, 800.0F));
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 6, wall);
    b.add_quad({1.5F, 2.98F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    b.add_object("box", places[0]);
    b.add_box({-0.4F, 0, -0.4F}, {0.4F, 0.8F, 0.4F}, false, 3, wall);
    b.add_object("lamp", places[1]);
    b.add_box({-0.3F, 0.0F, -0.3F}, {0.3F, 0.1F, 0.3F}, false, 1, wall);
    b.add_quad({-0.25F, -0.01F, -0.25F}, {0.5F, 0, 0}, {0, 0, 0.5F}, 1, 1, lamp);
    b.add_object("small box", places[2]);
    b.add_box({-0.2F, 0, -0.2F}, {0.2F, 0.4F, 0.2F}, false, 2, wall);
    return b;
}

const Places at_first = {at({1.2F, 0, 1.5F}), at({3.0F, 1.6F, 1.0F}), at({2.6F, 0, 3.0F})};

struct Case {
    std::string name;
    std::vector<Places> moves;  ///< the last one is where everything ends
    bool everyday = false;
};

Places with(Places places, std::size_t object, const Transform& place) {
    places[object] = place;
    return places;
}

std::vector<Case> cases() {
    const Places half_in_wall = with(at_first, 0, at({4.0F, 0, 2.0F}));
    const Places far_away = with(at_first, 0, at({40.0F, 0, 2.0F}));
    const Places vanished = with(at_first, 0, at({1.2F, 0, 1.5F}, 0.0F));
    const Places on_the_box = with(at_first, 2, at({1.2F, 0.8F, 1.5F}));
    const Places beside_the_box = with(at_first, 2, at({1.8F, 0, 1.5F}));
    const Places lamp_elsewhere = with(at_first, 1, at({0.9F, 2.2F, 3.0F}));
    const Places small_lamp = with(at_first, 1, at({3.0F, 1.6F, 1.0F}, 0.3F));
    const Places all = {at({2.6F, 0, 2.4F}), at({1.0F, 2.0F, 1.0F}), at({0.6F, 0.3F, 2.8F}, 1.5F)};
    return {{"stands half in the wall", {half_in_wall}},
            {"goes through the wall and back", {half_in_wall, far_away, half_in_wall, at_first}},
            {"is far away", {half_in_wall, far_away}},
            {"vanishes", {vanished}},
            {"vanishes and comes back", {vanished, at_first}},
            {"stands on the other", {on_the_box}},
            {"stands beside the other, faces touching", {beside_the_box}},
            {"carries a lamp", {lamp_elsewhere}},
            {"carries a lamp that shrinks", {small_lamp}},
            {"all at once, through a wall, with a lamp, onto each other",
             {half_in_wall, with(on_the_box, 1, lamp_elsewhere[1]), vanished, all},
             true}};
}

void move_all(Solver& solver, const Places& places) {
    std::vector<ObjectMove> moves;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        moves.push_back({i + 1, places[i].matrix()});
    }
    solver.move_objects(moves, {});
    while (solver.correcting()) {
        solver.step({});
    }
}

/// The moved solution iterates twice as long as the fresh ones have, since its samples weigh less
/// at first. 5 standard deviations of some 700 patches: by chance with a probability below 0.1 %,
/// were they normal; few solves tell a deviation badly, so the everyday bound is 7.
TEST(MovedEqualsFresh, PatchByPatch) {
    const double bound = all_cases ? 5.0 : 7.0;
    for (const Case& c : cases()) {
        if (!all_cases && !c.everyday) {
            continue;
        }
        const FreshSolves fresh =
            solve_afresh(room(c.moves.back()), quick(100), solves, iterations_at_rest);
        const SceneBuilder b = room(at_first);
        Solver solver(b.scene, b.mesh, quick(1));
        iterate(solver, 64);
        for (const Places& places : c.moves) {
            move_all(solver, places);
            iterate(solver, 8);
        }
        iterate(solver, 2 * iterations_at_rest);
        std::vector<double> moved = luminances(solver);
        for (std::size_t i = 0; i < moved.size(); ++i) {  // what has no area receives nothing
            const std::uint32_t object = b.mesh.vertex_object[b.mesh.triangles[i].x];
            const bool none = object > 0 && c.moves.back()[object - 1].scale == glm::vec3(0.0F);
            moved[i] = none ? fresh.mean[i] : moved[i];
        }
        EXPECT_LT(fresh.worst(moved), bound) << c.name;
        EXPECT_NEAR(fresh.level(moved), 1.0, all_cases ? 0.02 : 0.05) << c.name;
        EXPECT_EQ(solver.non_finite(), 0U);
        RecordProperty(c.name, std::to_string(fresh.worst(moved)));
    }
}

}  // namespace
}  // namespace raybundle::moved_equals_fresh_test
