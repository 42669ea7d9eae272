// SPDX-License-Identifier: Apache-2.0
// Scenes with closed forms, method by method, in the few runs that are quick; all of them, with
// more iterations, in ../heavy/known_scene_statistics_test.cpp. Seeds are fixed.
#include <gtest/gtest.h>

#include "hard_rooms.h"
#include "methods.h"

namespace raybundle {
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
                    Quick{"dim_room", bright_and_dim_room, perspective(), 4096, 0.02},
                    Quick{"dim_room", bright_and_dim_room, combined(), 2048, 0.02},
                    Quick{"tetrahedron", tetrahedron, combined(), 2048, 0.005},
                    Quick{"tetrahedron", tetrahedron, single_ray(), 2048, 0.005},
                    Quick{"sphere", sphere, three_strategies(), 1024, 0.005},
                    Quick{"sphere", sphere, single_ray(), 2048, 0.005}),
    quick_name);

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
}  // namespace raybundle
