// SPDX-License-Identifier: Apache-2.0
// Randomised hemicubes of glossy shooters (ch. 5.2).
#include <gtest/gtest.h>

#include <cmath>

#include "bundle/face_choice.h"
#include "oracle/oracle_solve.h"

namespace raybundle::random_faces_test {
namespace {

/// Every face counts once in the mean, whatever the lobe; the one with the lobe is always there.
TEST(RandomFaces, WeighOneInTheMean) {
    constexpr int steps = 20'000;
    for (const float share : {0.0F, 0.5F, 0.95F, 1.0F}) {
        for (const glm::vec3& lobe : {glm::vec3(0, 0, 1), glm::vec3(-2, 0.3F, 1)}) {
            std::array<double, Hemicube::face_count> sums{};
            double drawn = 0.0;
            for (int i = 0; i < steps; ++i) {
                const FaceWeights w =
                    choose_faces(lobe, share, (static_cast<float>(i) + 0.5F) / steps);
                for (std::size_t face = 0; face < w.size(); ++face) {
                    sums[face] += static_cast<double>(w[face]) / steps;
                    drawn += w[face] > 0.0F ? 1.0 / steps : 0.0;
                }
                EXPECT_TRUE(share < 0.5F || w[lobe.x < -1.0F ? 2 : 0] > 0.0F);
            }
            for (const double sum : sums) {
                EXPECT_NEAR(sum, 1.0, 2e-3);
            }
            EXPECT_LT(drawn, share == 0.0F ? 2.6 : 2.5);
        }
    }
}

/// Mean irradiance of a room of metal round a lamp, with all faces and with some. Over eight seeds
/// each, 5 standard errors are passed by chance with a probability of 2e-4 (t, 14 degrees).
TEST(HeavyRandomFaces, ChangeNothingButNoise) {
    SceneBuilder b;
    Material metal;
    metal.base_colour = glm::vec3(0.5F);
    metal.metallic = 1.0F;
    metal.roughness = 0.5F;
    const auto wall = b.add_material(metal);
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 6, wall);
    b.add_quad({1.5F, 2.9F, 2}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    constexpr int seeds = 8;
    const auto measure = [&](bool some) {
        std::vector<double> means;
        for (int seed = 1; seed <= seeds; ++seed) {
            SolverSettings settings;
            settings.seed = static_cast<std::uint64_t>(seed + (some ? 100 : 0));
            settings.random_faces = some;
            settings.coarse = {96, 200};
            settings.coarse_iterations = 1'000'000;
            Solver solver(b.scene, b.mesh, settings);
            while (solver.iterations() < 512) {
                solver.step({});
            }
            means.push_back(mean_irradiance(b, solver.store().read_irradiance()));
        }
        double mean = 0.0;
        double square = 0.0;
        for (const double m : means) {
            mean += m / seeds;
            square += m * m / seeds;
        }
        return std::pair(mean, std::sqrt((square - mean * mean) / (seeds - 1)));
    };
    const auto [all, all_error] = measure(false);
    const auto [some, some_error] = measure(true);
    const double error = std::hypot(all_error, some_error);
    EXPECT_NEAR(some, all, 5.0 * error);
    EXPECT_LT(error, 0.01 * all) << all << " and " << some;
}

}  // namespace
}  // namespace raybundle::random_faces_test
