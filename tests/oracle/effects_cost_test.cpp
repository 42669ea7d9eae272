// SPDX-License-Identifier: Apache-2.0
// Effects that a scene does not call for cost nothing, those that it does as much as the plan says.
#include <gtest/gtest.h>

#include <algorithm>

#include "../reference/lit_room.h"
#include "oracle/oracle_solve.h"
#include "scene/effects/effects_plan.h"
#include "transport/solver.h"

namespace raybundle::effects_cost_test {
namespace {

SceneBuilder room(bool glossy, bool punctual) {
    SceneBuilder b = lit_room(odd_rotation(), 12);
    if (!punctual) {
        b.scene.punctual_lights.clear();
    }
    b.scene.vertices.resize(3);  // a triangle of the file that uses the material
    b.scene.triangles.push_back({});
    if (glossy) {
        b.scene.materials[0].specular = 1.0F;
        b.scene.materials[0].roughness = 0.4F;
    }
    return b;
}

/// Bytes of the solution's buffers, without what does not grow with the patches.
std::size_t patch_bytes(const Solver& solver, std::size_t patches) {
    const FirstShot* first = solver.store().first_shot();
    const std::size_t fixed = first == nullptr ? 0 : first->bytes() - 32 * patches;
    // The room's patches share no vertices; those of files have about half as many.
    const std::size_t vertices = solver.scene().vertex_count();
    return solver.store().bytes() - fixed - (vertices - patches / 2) * sizeof(layout::VertexLight);
}

class EffectBytes : public testing::TestWithParam<std::pair<bool, bool>> {};

TEST_P(EffectBytes, AreThoseOfThePlan) {
    const SceneBuilder b = room(GetParam().first, GetParam().second);
    const std::size_t patches = b.mesh.patch_count();
    const Solver solver(b.scene, b.mesh);
    const EffectsPlan plan = plan_effects(b.scene, patches);
    // Reflectors belong to the scene on the GPU, power blocks are less than a byte a patch.
    const std::size_t reflectors = GetParam().first ? 16 * patches : 0;
    const double actual = static_cast<double>(patch_bytes(solver, patches) + reflectors) /
                          static_cast<double>(patches);
    EXPECT_NEAR(actual, static_cast<double>(plan.bytes_per_patch), 1.0);
    const auto& defines = solver.scene().defines();
    const auto has = [&](const char* define) {
        return std::find(defines.begin(), defines.end(), define) != defines.end();
    };
    EXPECT_EQ(has("GLOSSY 1"), GetParam().first);
    EXPECT_EQ(has("FIRST_SHOT 1"), GetParam().second);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EffectBytes,
                         testing::Values(std::pair(false, false), std::pair(true, false),
                                         std::pair(false, true), std::pair(true, true)),
                         [](const auto& test) {
                             return std::string(test.param.first ? "glossy" : "diffuse") +
                                    (test.param.second ? "_punctual" : "");
                         });

}  // namespace
}  // namespace raybundle::effects_cost_test
