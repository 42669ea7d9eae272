// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "oracle/scene_builder.h"
#include "scene/mesh/patch_mesh.h"
#include "transport/solver.h"

namespace raybundle::facet_test {
namespace {

/// A lit room with a block in it, as a file would describe it: two triangles a side.
Scene room() {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(900.0F, 1000.0F, 800.0F));
    b.add_box({0, 0, 0}, {4, 3, 4.5F}, true, 1, wall);
    b.add_box({1, 0, 1}, {1.7F, 1.1F, 2.2F}, false, 1, wall);
    b.add_quad({1.5F, 2.98F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
    for (std::size_t i = 0; i < b.mesh.positions.size(); ++i) {
        b.scene.vertices.push_back({b.mesh.positions[i], b.mesh.normals[i], glm::vec2(0.0F)});
    }
    for (std::size_t i = 0; i < b.mesh.triangles.size(); ++i) {
        const glm::uvec3& t = b.mesh.triangles[i];
        b.scene.triangles.push_back({{t.x, t.y, t.z}, b.mesh.triangle_material[i], 0});
    }
    return b.scene;
}

std::vector<glm::vec4> solve(const Scene& scene, const PatchMesh& mesh) {
    SolverSettings settings;
    settings.coarse = {256, 400};
    settings.coarse_iterations = 1'000'000;
    Solver solver(scene, mesh, settings);
    // One group: shooters that are chosen by the outcome would differ by more than the outcome.
    for (int i = 0; i < GROUP_SIZE; ++i) {
        solver.step({});
    }
    return solver.store().read_irradiance();
}

/// Patches that are found through the facets they tile, and patches that are rasterised themselves,
/// receive the same from the same bundles: only pixels on edges may fall to either side.
TEST(Facets, GivePatchesWhatTheirOwnTrianglesWould) {
    Scene scene = room();
    TessellationSettings tessellation;
    tessellation.patch_size = 0.3F;
    PatchMesh mesh = tessellate(scene, tessellation);
    ASSERT_EQ(mesh.facets.size(), 26U);
    const std::vector<glm::vec4> through_facets = solve(scene, mesh);
    mesh.facets.clear();
    const std::vector<glm::vec4> themselves = solve(scene, mesh);
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < themselves.size(); ++i) {
        const double a = static_cast<double>(through_facets[i].g);
        const double b = static_cast<double>(themselves[i].g);
        difference += (a - b) * (a - b);
        size += b * b;
    }
    EXPECT_LT(std::sqrt(difference / size), 0.01);
}

}  // namespace
}  // namespace raybundle::facet_test
