// SPDX-License-Identifier: Apache-2.0
// Light ends where surfaces touch: a floor runs on under a wall into the next room.
#include <gtest/gtest.h>

#include <algorithm>

#include "oracle/scene_builder.h"
#include "transport/solver.h"

namespace raybundle::contact_test {
namespace {

/// A room of 6 x 3 x 3 m of undivided faces, a lamp in its first half, and across its middle a wall
/// from face to face: a box of its own, 20 cm thick.
Scene divided_room() {
    SceneBuilder b;
    const auto paint = b.add_material(glm::vec3(0.5F));
    const auto lamp = b.add_material(glm::vec3(0.5F), glm::vec3(100.0F));
    b.add_box({0, 0, 0}, {6, 3, 3}, true, 1, paint);
    b.add_quad({1, 2.9F, 1}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
    b.add_object("wall");
    b.add_box({2.93F, 0, 0}, {3.13F, 3, 3}, false, 1, paint);
    return b.loaded_scene();
}

TEST(Contact, NoLightGoesUnderAWallIntoTheNextRoom) {
    Scene scene = divided_room();
    TessellationSettings tessellation;
    tessellation.patch_size = 0.5F;
    const PatchMesh mesh = tessellate(scene, tessellation);
    SolverSettings settings;
    settings.coarse = {64, 160};
    Solver solver(scene, mesh, settings);
    while (solver.iterations() < 256) {
        solver.step({});
    }
    const auto irradiance = solver.store().read_irradiance();
    float lit = 0.0F;
    float dark = 0.0F;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[mesh.side_triangle[i]];
        const float x =
            (mesh.positions[t.x].x + mesh.positions[t.y].x + mesh.positions[t.z].x) / 3.0F;
        if (x < 2.93F || x > 3.13F) {  // else: inside the wall, where nobody looks
            float& largest = x < 3.0F ? lit : dark;
            largest = std::max(largest, irradiance[i].x);
        }
    }
    EXPECT_GT(lit, 10.0F);
    EXPECT_EQ(dark, 0.0F);  // 0.12 lx with patches that reach under the wall
}

}  // namespace
}  // namespace raybundle::contact_test
