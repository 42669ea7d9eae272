// SPDX-License-Identifier: Apache-2.0
// Scenes with closed forms, method by method, in the few runs that are quick; all of them, with
// more iterations, in ../heavy/known_scene_statistics_test.cpp. Seeds are fixed.
#include <gtest/gtest.h>

#include <utility>

#include "hard_rooms.h"
#include "methods.h"

namespace raybundle::known_scene_test {
namespace {

std::string method_name(const testing::TestParamInfo<Method>& info) {
    return info.param.name;
}

struct Quick {
    const char* scene;
    KnownScene (*make)();
    Method method;
    std::uint64_t iterations;
    double bound;  // relative
};

std::string quick_name(const testing::TestParamInfo<Quick>& info) {
    return std::string(info.param.scene) + "_" + info.param.method.name;
}

class KnownSceneQuick : public testing::TestWithParam<Quick> {};

TEST_P(KnownSceneQuick, HasTheIrradianceOfItsClosedForm) {
    const KnownScene scene = GetParam().make();
    OracleSettings settings;
    settings.iterations = GetParam().iterations;
    const auto found = irradiance_by(GetParam().method, scene.builder, settings);
    for (const KnownPatches& known : scene.known) {
        const double mean = area_mean(scene.builder.mesh, found, known.first, known.last);
        EXPECT_NEAR(mean / known.irradiance, 1.0, GetParam().bound);
    }
}

KnownScene million_to_one() {
    return bright_and_dim_room(1e6F);
}
KnownScene close_squares() {
    return unit_squares(0.01);
}
KnownScene tetrahedron() {
    return tetrahedron_furnace(0.5F);
}
KnownScene sphere() {
    return sphere_furnace(0.5F);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, KnownSceneQuick,
    testing::Values(Quick{"plates", parallel_plates, layered(), 1024, 0.01},
                    Quick{"squares", close_squares, layered(), 2048, 0.005},
                    Quick{"squares", close_squares, perspective(), 1024, 0.005},
                    Quick{"squares", close_squares, single_ray(), 2048, 0.005},
                    Quick{"dim_room", million_to_one, perspective(), 4096, 0.02},
                    Quick{"dim_room", million_to_one, combined(), 2048, 0.02},
                    Quick{"tetrahedron", tetrahedron, combined(), 2048, 0.005},
                    Quick{"tetrahedron", tetrahedron, single_ray(), 2048, 0.005},
                    Quick{"sphere", sphere, three_strategies(), 1024, 0.005},
                    Quick{"sphere", sphere, single_ray(), 2048, 0.005}),
    quick_name);

/// A white plate of 1 m² hangs 1 m above a shining black field of 16 x 16 m: of all light that is
/// sent 1 in 250 arrives anywhere. What the field receives below the plate is what the plate
/// reflects times the form factor of facing unit squares (Howell, C-11); the light that escapes
/// says next to nothing about it.
void expect_plate_reflects(const Method& method, double bound) {
    constexpr double factor = 0.199825;  // of squares 1 m apart
    constexpr float albedo = 0.9F;
    SceneBuilder b;
    const auto white = b.add_material(glm::vec3(albedo));
    const auto field = b.add_material(glm::vec3(0.0F), glm::vec3(100.0F));
    b.add_quad({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 4, 4, white);
    const std::size_t below = b.mesh.patch_count();
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 4, 4, field);
    const std::size_t rest = b.mesh.patch_count();
    b.add_quad({-8, 0, -8}, {0, 0, 16}, {8, 0, 0}, 16, 8, field);
    b.add_quad({1, 0, -8}, {0, 0, 16}, {7, 0, 0}, 16, 7, field);
    b.add_quad({0, 0, -8}, {0, 0, 8}, {1, 0, 0}, 8, 1, field);
    b.add_quad({0, 0, 1}, {0, 0, 7}, {1, 0, 0}, 7, 1, field);
    // Black surfaces take part in the choice of shooters.
    b.add_quad({-12, -1, -12}, {24, 0, 0}, {0, 0, 24}, 4, 4, b.add_material(glm::vec3(0.0F)));
    OracleSettings settings;
    settings.iterations = 4096;
    settings.resolution = {128, 240};
    const auto found = irradiance_by(method, b, settings);
    const double received = area_mean(b.mesh, found, 0, below);
    const double reflected = area_mean(b.mesh, found, below, rest);
    EXPECT_NEAR(received, 0.985 * 100.0 * glm::pi<double>(), 0.01 * received);
    EXPECT_NEAR(reflected / (static_cast<double>(albedo) * received * factor), 1.0, bound);
}

TEST(OpenField, PlateAboveItReflectsWhatItReceives) {
    expect_plate_reflects(combined(), 0.04);
}

/// Few of the perspective bundles set out from the plate.
TEST(HeavyOpenField, PlateAboveItReflectsWhatItReceivesByPerspectiveBundlesAlone) {
    expect_plate_reflects(perspective(), 0.15);
}

class DensityOfOneStrategy : public testing::TestWithParam<Method> {};

/// What the oracles can see: a density that is wrong by 2 % brings 2 % too much or too little
/// light, of every strategy by itself (planes: oracle_test.cpp). The correct one stays within 0.5
/// %.
TEST_P(DensityOfOneStrategy, WrongByTwoPercentIsCaught) {
    const KnownScene scene = sphere_furnace(0.0F);
    const KnownPatches& known = scene.known.front();
    OracleSettings settings;
    settings.iterations = 512;
    const auto ratio = [&](float density_error) {
        settings.density_error = density_error;
        const auto found = irradiance_by(GetParam(), scene.builder, settings);
        return area_mean(scene.builder.mesh, found, known.first, known.last) / known.irradiance;
    };
    EXPECT_NEAR(ratio(1.0F), 1.0, 0.005);
    EXPECT_LT(ratio(1.02F), 1.0 - 0.005);
    EXPECT_GT(ratio(0.98F), 1.0 + 0.005);
}

INSTANTIATE_TEST_SUITE_P(Strategies, DensityOfOneStrategy,
                         testing::Values(layered(), perspective(), combined()), method_name);

/// Single rays have no density of their own to put wrong; all light being 2 % too much is seen.
TEST(SingleRayProof, TwoPercentOfLightIsCaught) {
    KnownScene scene = unit_squares(0.01);
    for (glm::vec3& emission : scene.builder.mesh.emission) {
        emission *= 1.02F;
    }
    for (Material& material : scene.builder.scene.materials) {
        material.emission *= 1.02F;
    }
    OracleSettings settings;
    settings.iterations = 2048;
    const KnownPatches& known = scene.known.front();
    const auto found = irradiance_by(single_ray(), scene.builder, settings);
    EXPECT_GT(area_mean(scene.builder.mesh, found, known.first, known.last) / known.irradiance,
              1.0 + 0.005);
}

}  // namespace
}  // namespace raybundle::known_scene_test
