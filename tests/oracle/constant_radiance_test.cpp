// SPDX-License-Identifier: Apache-2.0
// The constant radiance term (ch. 5.5): bundles carry what radiance is beyond its mean, so that
// lines that meet nothing, or a back, lack it. Neither patches nor pixels may show any difference
// but noise.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "oracle/scene_builder.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::constant_radiance_test {
namespace {

constexpr glm::uvec2 size(32, 24);
constexpr int seeds = 4;
/// For the t distribution of two times four samples, passed by chance with a probability of 6e-4.
constexpr double sigmas = 6.5;

/// A room without its front and one side, a lamp that hangs in it, and a block.
SceneBuilder open_room() {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.7F, 0.6F, 0.5F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(100.0F));
    b.add_quad({0, 0, 0}, {0, 0, 5}, {4, 0, 0}, 5, 5, wall);
    b.add_quad({0, 3, 0}, {4, 0, 0}, {0, 0, 5}, 5, 5, wall);
    b.add_quad({4, 0, 0}, {0, 0, 5}, {0, 3, 0}, 5, 5, wall);
    b.add_quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 5, 5, wall);
    b.add_quad({1.5F, 2.5F, 2}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    b.add_box({1, 0.2F, 1}, {2.5F, 0.8F, 2.5F}, false, 2, wall);
    return b;
}

Camera camera_at(const glm::vec3& eye) {
    Camera camera;
    camera.eye = eye;
    camera.target = {2.0F, 0.9F, 1.5F};
    camera.vertical_fov = 0.8F;
    return camera;
}

struct Outcome {
    std::vector<double> irradiance;  ///< of every patch, lx
    std::vector<double> pixels;      ///< radiance, cd/m²
};

/// The camera goes a little aside half-way, so that accumulators have been carried over.
Outcome solve(const SceneBuilder& b, SolverSettings settings, std::uint64_t iterations) {
    settings.coarse = {128, 240};
    settings.coarse_iterations = 1'000'000;
    Solver solver(b.scene, b.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(camera_at({-1.2F, 2.2F, 6.0F}));
    BundleReceiver* const receivers[] = {&image};
    while (solver.iterations() < iterations) {
        if (solver.iterations() == iterations / 2) {
            image.set_camera(camera_at({-1.0F, 2.3F, 6.0F}));
        }
        solver.step(receivers);
    }
    Outcome result;
    for (const glm::vec4& e : solver.store().read_irradiance()) {
        result.irradiance.push_back(e.x);
    }
    for (const glm::vec4& p : image.read_radiance()) {
        result.pixels.push_back(static_cast<double>(p.g));
    }
    return result;
}

struct Mean {
    double value = 0.0, standard_error = 0.0;
};

/// Over the seeds, of the mean of some values.
template <typename Values>
Mean mean_of(const std::vector<Outcome>& outcomes, Values values) {
    std::vector<double> means;
    for (const Outcome& o : outcomes) {
        const std::vector<double> some = values(o);
        double sum = 0.0;
        for (const double v : some) {
            sum += v / static_cast<double>(some.size());
        }
        means.push_back(sum);
    }
    Mean m;
    for (const double v : means) {
        m.value += v / seeds;
    }
    for (const double v : means) {
        m.standard_error += (v - m.value) * (v - m.value) / (seeds * (seeds - 1.0));
    }
    m.standard_error = std::sqrt(m.standard_error);
    return m;
}

void expect_equal(const Mean& a, const Mean& b, double largest_error, const char* what) {
    const double error = std::hypot(a.standard_error, b.standard_error);
    EXPECT_NEAR(a.value, b.value, sigmas * error) << what;
    EXPECT_LT(error, largest_error * a.value) << what;
}

class ConstantRadiance : public testing::TestWithParam<StrategyProbabilities> {};

TEST_P(ConstantRadiance, ChangesNothingButNoise) {
    const SceneBuilder room = open_room();
    std::vector<Outcome> without;
    std::vector<Outcome> with;
    for (int seed = 1; seed <= seeds; ++seed) {
        SolverSettings settings;
        settings.seed = static_cast<std::uint64_t>(seed);
        settings.probabilities = GetParam();
        without.push_back(solve(room, settings, 400));
        settings.seed += 100;
        settings.constant_radiance = true;
        with.push_back(solve(room, settings, 400));
    }
    const auto patches = [](const Outcome& o) { return o.irradiance; };
    const auto picture = [](const Outcome& o) { return o.pixels; };
    expect_equal(mean_of(without, patches), mean_of(with, patches), 0.02, "patches");
    expect_equal(mean_of(without, picture), mean_of(with, picture), 0.03, "picture");
}

INSTANTIATE_TEST_SUITE_P(Strategies, ConstantRadiance,
                         testing::Values(StrategyProbabilities{0.3F, 0.0F, 0.7F}));
INSTANTIATE_TEST_SUITE_P(HeavyStrategies, ConstantRadiance,
                         testing::Values(StrategyProbabilities{0.3F, 0.3F, 0.4F}));

/// In a furnace of radiance L, a shading normal that tilts by t from its surface receives
/// pi L (1 + cos t)/2, since light comes from the surface's side only.
TEST(ConstantRadianceInAFurnace, LightsTiltedNormalsAsTheirSurfaceDoes) {
    constexpr float albedo = 0.5F;
    constexpr double radiance = 100.0 / (1.0 - 0.5);
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(albedo), glm::vec3(100.0F));
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 4, wall);
    for (glm::vec3& n : b.mesh.normals) {
        n = n.y > 0.9F ? glm::normalize(glm::vec3(1, 1, 0)) : n;
    }
    for (const bool constant : {false, true}) {
        SolverSettings settings;
        settings.constant_radiance = constant;
        settings.coarse = {128, 240};
        settings.coarse_iterations = 1'000'000;
        Solver solver(b.scene, b.mesh, settings);
        ASSERT_EQ(solver.scene().constant_radiance(), constant);
        const ViewPrograms programs(solver.scene());
        ViewerImage image(solver.scene(), solver.store(), programs, size);
        Camera camera;
        camera.eye = {2.0F, 2.5F, 2.0F};
        camera.target = {2.0F, 0.0F, 2.001F};
        camera.vertical_fov = 0.6F;
        image.set_camera(camera);
        BundleReceiver* const receivers[] = {&image};
        while (solver.iterations() < 768) {
            solver.step(receivers);
        }
        double mean = 0.0;
        for (const glm::vec4& p : image.read_radiance()) {
            mean += static_cast<double>(p.g) / (size.x * size.y);
        }
        const double share = 0.5 + 0.5 / std::sqrt(2.0);
        const double exact = 100.0 + static_cast<double>(albedo) * radiance * share;
        // Pixels blend in 1/60 or so of the patches' irradiance, which knows no tilt.
        EXPECT_NEAR(mean, exact, 0.01 * exact) << constant;
    }
}

/// Perspective bundles alone never look along lines that meet nothing: there the term stays away.
TEST(ConstantRadianceOfOpenRooms, StaysAwayWhereLightEscapesUnseen) {
    const SceneBuilder room = open_room();
    SolverSettings settings;
    settings.probabilities = {0.0F, 0.0F, 1.0F};
    const Outcome without = solve(room, settings, 64);
    settings.constant_radiance = true;
    const Outcome with = solve(room, settings, 64);
    EXPECT_EQ(without.irradiance, with.irradiance);
}

}  // namespace
}  // namespace raybundle::constant_radiance_test
