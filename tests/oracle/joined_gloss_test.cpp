// SPDX-License-Identifier: Apache-2.0
// Patches of several triangles that do not reflect alike in all directions.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "ball.h"
#include "methods.h"
#include "oracle/oracle_solve.h"
#include "oracle/scene_builder.h"
#include "scene/mesh/patch_means.h"

namespace raybundle::joined_gloss_test {
namespace {

Material glossy(float metallic, float roughness, float colour) {
    Material material;
    material.base_colour = glm::vec3(colour);
    material.metallic = metallic;
    material.roughness = roughness;
    return material;
}

/// A floor of 0.4 x 2 m that goes up and down by 20 degrees, each patch a rise and a fall.
void add_ridges(SceneBuilder& b, std::uint32_t material) {
    constexpr int ridges = 8;
    constexpr int cells = 20;
    const float width = 0.4F / ridges;
    const float depth = 2.0F / cells;
    const float height = 0.5F * width * std::tan(std::numbers::pi_v<float> / 9.0F);
    for (int i = 0; i < ridges; ++i) {
        for (int j = 0; j < cells; ++j) {
            const glm::vec3 at(width * static_cast<float>(i), 0.0F,
                               -1.0F + depth * static_cast<float>(j));
            const glm::vec3 along(0, 0, depth);
            const glm::vec3 up(0.5F * width, height, 0);
            const glm::vec3 down(0.5F * width, -height, 0);
            b.add_quad(at, along, up, 1, 1, material);
            b.add_quad(at + up, along, down, 1, 1, material);
        }
    }
}

/// Mean irradiance of a black plate that faces ridges of metal, below a lamp that it does not see.
double over_ridges(const StrategyProbabilities& probabilities) {
    SceneBuilder b;
    add_ridges(b, b.add_material(glossy(1.0F, 0.3F, 0.9F)));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    const auto black = b.add_material(glm::vec3(0.0F));
    b.add_quad({-0.9F, 1, -0.2F}, {0.4F, 0, 0}, {0, 0, 0.4F}, 2, 2, lamp);
    const std::size_t plate = b.mesh.side_count();
    b.add_quad({0.9F, 1, -0.2F}, {0.4F, 0, 0}, {0, 0, 0.4F}, 2, 2, black);
    b.join(4);
    OracleSettings settings;
    settings.iterations = 3072;
    settings.resolution = {64, 160};
    settings.probabilities = probabilities;
    return mean_irradiance(b, solve(b, settings).store().read_irradiance(), plate,
                           b.mesh.side_count());
}

/// Bundles of both kinds have to know one and the same patch: their samples are weighed as such.
TEST(JoinedGloss, SendsTheSameThroughBundlesOfBothKinds) {
    const double layered = over_ridges({1.0F, 0.0F, 0.0F});
    const double perspective = over_ridges({0.0F, 0.0F, 1.0F});
    EXPECT_NEAR(perspective / layered, 1.0, 0.1);
}

/// Flux, lm, on the sides of all materials but one, and on those of that one.
glm::dvec2 fluxes(const PatchMesh& mesh, const std::vector<glm::vec4>& irradiance,
                  std::uint32_t material) {
    glm::dvec2 sum(0.0);
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        const bool own = mesh.triangle_material[mesh.side_triangle[side]] == material;
        sum[own ? 1 : 0] +=
            double{side_area(mesh, side)} * static_cast<double>(irradiance[mesh.patch_of(side)].g);
    }
    return sum;
}

/// Share of the light that a ball sends back of what falls on it from a lamp, in a black box.
double albedo_of_ball(const Material& surface, bool join) {
    SceneBuilder b;
    const auto ball = b.add_material(surface);
    const auto black = b.add_material(glm::vec3(0.0F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_box({-1, -1, -1}, {1, 1, 1}, true, 1, black);
    b.add_quad({-0.9F, 0.99F, -0.4F}, {0.8F, 0, 0}, {0, 0, 0.8F}, 2, 2, lamp);
    add_ball(b, {0, 0, 0}, 0.9F, 16, ball);
    Scene scene = b.loaded_scene();
    TessellationSettings tessellation;
    tessellation.patch_size = 3.0F;
    tessellation.target_patches = 1;
    tessellation.join_triangles = join;
    const PatchMesh mesh = tessellate(scene, tessellation);
    OracleSettings settings;
    // The ratio of two solves has a standard deviation of some 0.5 %: the bound is six of them.
    settings.iterations = 2048;
    settings.resolution = {64, 160};
    const glm::dvec2 flux =
        fluxes(mesh, solve(scene, mesh, settings).store().read_irradiance(), ball);
    const double sent = std::numbers::pi * 1000.0 * 0.64;
    return (flux.x + flux.y - sent) / flux.y;
}

class JoinedBall : public testing::TestWithParam<std::array<float, 2>> {};

TEST_P(JoinedBall, SendsAsMuchLightAsItsTriangles) {
    const Material surface = glossy(GetParam()[0], GetParam()[1], 0.8F);
    const double apart = albedo_of_ball(surface, false);
    EXPECT_NEAR(albedo_of_ball(surface, true) / apart, 1.0, 0.03) << apart;
}

INSTANTIATE_TEST_SUITE_P(Materials, JoinedBall,
                         testing::Values(std::array{0.0F, 0.3F}, std::array{1.0F, 0.0F}));
INSTANTIATE_TEST_SUITE_P(HeavyMaterials, JoinedBall,
                         testing::Values(std::array{0.0F, 1.0F}, std::array{1.0F, 0.4F}));

}  // namespace
}  // namespace raybundle::joined_gloss_test
