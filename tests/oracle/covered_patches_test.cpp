// SPDX-License-Identifier: Apache-2.0
// Surfaces that touch: what lies between them loses all that it sends, and what few shots say of
// that must not decide how bright the rest is.
#include <gtest/gtest.h>

#include <cmath>

#include "oracle/scene_builder.h"
#include "transport/solver.h"

namespace raybundle::covered_patches_test {
namespace {

constexpr float albedo = 0.7F;
constexpr float emission = 100.0F;
constexpr double furnace = 3.14159265358979 * 100.0 / (1.0 - 0.7);  // lx

/// A furnace: a cube of 4 m, on whose floor a box stands that covers whole cells.
SceneBuilder furnace_with_box() {
    SceneBuilder b;
    const auto paint = b.add_material(glm::vec3(albedo), glm::vec3(emission));
    b.add_box({0, 0, 0}, {4, 4, 4}, true, 8, paint);
    b.add_object("box");
    b.add_box({1, 0, 1}, {2.5F, 1, 2.5F}, false, 3, paint);
    return b;
}

bool covered(const glm::vec3& centre) {
    return centre.y < 1e-3F && centre.x > 1.0F && centre.x < 2.5F && centre.z > 1.0F &&
           centre.z < 2.5F;
}

/// Mean over the uncovered patches of the room, relative to the furnace's irradiance.
double level(const SceneBuilder& b, std::uint64_t seed) {
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = {64, 128};
    Solver solver(b.scene, b.mesh, settings);
    while (solver.iterations() < 768) {
        solver.step({});
    }
    const auto irradiance = solver.store().read_irradiance();
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < std::size_t{6 * 8 * 8 * 2}; ++i) {
        if (!covered(b.cell_centre(b.mesh.side_triangle[i]))) {
            sum += static_cast<double>(irradiance[i].x);
            count += 1.0;
        }
    }
    return sum / count / furnace;
}

TEST(CoveredPatches, LeaveTheLevelOfAFurnaceAsItIs) {
    const SceneBuilder b = furnace_with_box();
    double sum = 0.0;
    double squares = 0.0;
    constexpr int seeds = 8;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const double error = level(b, seed) - 1.0;
        sum += error;
        squares += error * error;
    }
    EXPECT_NEAR(sum / seeds, 0.0, 0.004);
    EXPECT_LT(std::sqrt(squares / seeds), 0.006);  // 0.0034; 0.0097 by one share for all shooters
}

}  // namespace
}  // namespace raybundle::covered_patches_test
