// SPDX-License-Identifier: Apache-2.0
// Selection of shooting patches: all densities divide by p_j, so they must be those that patches
// are chosen with.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../reference/lit_room.h"
#include "methods.h"
#include "scene/gltf/gltf_loader.h"
#include "solution/direct/first_shot.h"
#include "transport/patch_area.h"
#include "transport/solver.h"

namespace raybundle::selection_test {
namespace {

class SelectionProbabilities : public testing::TestWithParam<const char*> {};

/// Patches of one triangle each, and patches of several, where the scene has small triangles.
TEST_P(SelectionProbabilities, SumToOne) {
    for (const bool join : {false, true}) {
        Scene scene = load_gltf(std::string(RAYBUNDLE_SCENES) + "/" + GetParam() + ".gltf");
        TessellationSettings settings;
        settings.join_triangles = join;
        settings.target_patches = join ? 5000 : 25'000;  // few enough that some are joined
        const PatchMesh mesh = tessellate(scene, settings);
        Solver solver(scene, mesh);
        for (int i = 0; i < 32; ++i) {
            solver.step({});
        }
        std::vector<glm::vec4> sent(mesh.patch_count());
        solver.store().sent().read<glm::vec4>(sent);
        double sum = 0.0;
        for (std::uint32_t i = 0; i < sent.size(); ++i) {
            sum += static_cast<double>(sent[i].w) * patch_area(scene, mesh, i);
        }
        EXPECT_NEAR(sum, 1.0, 1e-4) << mesh.patch_count() << " patches";
    }
}

// One of each kind of what patches send by themselves.
INSTANTIATE_TEST_SUITE_P(Scenes, SelectionProbabilities,
                         testing::Values("cornell_box", "effects/punctual_lights",
                                         "effects/clear_sky", "effects/overcast_sky",
                                         "effects/caustics", "effects/glass",
                                         "effects/diffuse_transmission",
                                         "effects/roughness_texture"));

class FirstShotOf : public testing::TestWithParam<Method> {};

/// A black room but for its floor, which a spot lights: what the floor reflects arrives.
TEST_P(FirstShotOf, IsCarriedToTheLastLumen) {
    SceneBuilder b;
    const auto black = b.add_material(glm::vec3(0.0F));
    b.add_quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}, 24, 24, b.add_material(glm::vec3(0.5F)));
    const std::size_t floor = b.mesh.patch_count();
    b.add_quad({0, 3, 0}, {4, 0, 0}, {0, 0, 4}, 24, 24, black);
    b.add_quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 24, 24, black);
    b.add_quad({0, 0, 4}, {0, 3, 0}, {4, 0, 0}, 24, 24, black);
    b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 4}, 24, 24, black);
    b.add_quad({4, 0, 0}, {0, 0, 4}, {0, 3, 0}, 24, 24, black);
    add_punctual_light(b, glm::mat4(1.0F), PunctualKind::spot, {1.5F, 2.5F, 1.7F}, {0.1F, -1, 0.1F},
                       glm::vec3(100.0F));
    SolverSettings settings;
    settings.probabilities = *GetParam().bundles;
    settings.adapt_probabilities = false;
    settings.coarse = {128, 200};
    Solver solver(b.scene, b.mesh, settings);
    double sent = 0.0;
    const auto reflected = solver.store().first_shot()->read_reflected();
    for (std::size_t i = 0; i < floor; ++i) {
        sent += glm::pi<double>() * static_cast<double>(reflected[i].r) *
                static_cast<double>(solver.scene().radiance_unit()) *
                world_area(b.scene, b.mesh, i);
    }
    while (solver.iterations() < 768) {
        solver.step({});
    }
    double arrived = 0.0;
    const auto irradiance = solver.store().read_irradiance();
    for (std::size_t i = floor; i < irradiance.size(); ++i) {
        arrived += static_cast<double>(irradiance[i].r) * world_area(b.scene, b.mesh, i);
    }
    EXPECT_NEAR(arrived / sent, 1.0, 4e-3);
}

INSTANTIATE_TEST_SUITE_P(Strategies, FirstShotOf,
                         testing::Values(perspective(), layered(), combined()));

}  // namespace
}  // namespace raybundle::selection_test
