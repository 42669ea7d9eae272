// SPDX-License-Identifier: Apache-2.0
// Points in the air, whose paths share nothing with bundles, against the solution of bundles:
// points right above surfaces have the illuminance of their patches.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "../reference/lit_room.h"
#include "measure/point_measurement.h"
#include "oracle/oracle_solve.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle::points_agree_test {
namespace {

constexpr int place_count = 4000;

struct Agreement {
    double points = 0.0;  ///< mean over places that are even over all surfaces, lx
    double patches = 0.0;
    double error = 0.0;  ///< of their difference, two standard errors
};

/// `rounds` times place_count places that are even over all areas, so that a patch of many
/// triangles has its mean in the mean; a little above the surface.
Agreement compare(const Scene& scene, const PatchMesh& mesh, std::uint64_t iterations, int rounds) {
    OracleSettings settings;
    settings.iterations = iterations;
    const Solver solver = solve(scene, mesh, settings);
    const auto irradiance = solver.store().read_irradiance();
    const auto measured = std::make_shared<const MeasuredScene>(scene, mesh);
    const RayScene& rays = measured->rays;
    std::vector<double> areas;
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        areas.push_back(luminance(mesh.emission[side]) > 0.0F ? 0.0 : rays.patch_area(side));
    }
    const DiscreteDistribution sides(areas);
    const double per_metre = 1.0 / std::sqrt(rays.square_metres());
    const int count = rounds * place_count;
    Agreement result;
    double squares = 0.0;
    for (int round = 0; round < rounds; ++round) {
        std::vector<CalculationPoint> places;
        std::vector<double> patches;
        RandomStream random(3, static_cast<std::uint64_t>(round));
        for (int i = 0; i < place_count; ++i) {
            const auto side =
                static_cast<std::uint32_t>(sides.sample((i + random.next()) / place_count));
            const SurfacePoint point =
                rays.point_on_patch(side, uniform_triangle(random.next_pair()));
            const glm::dvec3 above = point.position + 1e-5 * rays.diameter() * point.normal;
            places.push_back({glm::dvec3(scene.bounds.centre()) + above / per_metre, point.normal});
            patches.push_back(
                static_cast<double>(luminance(glm::vec3(irradiance[mesh.patch_of(side)]))));
        }
        const auto seed = static_cast<std::uint64_t>(11 + round);
        PointMeasurement points(measured, places, {Quantity::normal, false, 1.0, seed});
        points.add_samples(8 * places.size());
        const std::vector<Interval> values = points.values();
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double apart = values[i].value - patches[i];
            result.points += values[i].value / count;
            result.patches += patches[i] / count;
            squares += apart * apart;
        }
    }
    result.error = 2.0 * std::sqrt(squares) / count;
    return result;
}

void expect_agreement(const Scene& scene, const PatchMesh& mesh, std::uint64_t iterations,
                      double bound, int rounds = 1) {
    const Agreement found = compare(scene, mesh, iterations, rounds);
    EXPECT_GT(found.patches, 0.0);
    EXPECT_NEAR(found.points, found.patches, bound * found.patches + found.error);
    EXPECT_LT(found.error, 0.05 * found.points);
    std::printf("points %.4g, patches %.4g, error %.2g\n", found.points, found.patches,
                found.error);
}

/// A lamp, a spot and sunlight, a box in the room.
TEST(PointsAgree, WithBundlesInALitRoom) {
    const SceneBuilder room = lit_room(glm::mat4(1.0F), 16);
    expect_agreement(room.scene, room.mesh, 1024, 0.02);
}

void expect_file(const std::string& path, double bound, int rounds) {
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << path << " is not there";
    }
    Scene scene = load_gltf(path);
    const PatchMesh mesh = tessellate(scene, {});
    expect_agreement(scene, mesh, 1024, bound, rounds);
}

const std::string others = RAYBUNDLE_SCENES "/../../shared/data/scenes";

TEST(PointsAgree, WithBundlesInTheCornellBox) {
    expect_file(RAYBUNDLE_SCENES "/cornell_box.gltf", 0.02, 1);
}

TEST(PointsAgreeHeavy, WithBundlesInBevysCornellBox) {
    expect_file(others + "/bevy_cornell_box/CornellBox.glb", 0.05, 4);
}

TEST(PointsAgreeHeavy, WithBundlesRoundBevysChair) {
    expect_file(others + "/bevy_mixed_lighting_chair/MixedLightingExample.gltf", 0.05, 4);
}

TEST(PointsAgreeHeavy, WithBundlesInTheLivingRoom) {
    expect_file(RAYBUNDLE_SCENES "/living_room.gltf", 0.05, 4);
}

}  // namespace
}  // namespace raybundle::points_agree_test
