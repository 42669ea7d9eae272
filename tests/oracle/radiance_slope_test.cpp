// SPDX-License-Identifier: Apache-2.0
// Light that changes within patches, beside surfaces that see how.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "oracle/scene_builder.h"
#include "pictures.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::radiance_slope_test {
namespace {

constexpr glm::uvec2 size(16, 16);
constexpr unsigned rows = 4;  // at the top, which are compared
constexpr std::uint64_t iterations = 2048;

struct Beam {
    std::string name;
    StrategyProbabilities strategies{};
    bool below = false;  // the ceiling runs on above it
};

void PrintTo(const Beam& beam, std::ostream* out) {
    *out << beam.name;
}

/// A room of 4 x 2.5 x 4 m with a lamp on one wall. A beam under the ceiling keeps the lamp's
/// light from the ceiling behind it: the farther from the beam, the brighter it is.
Scene room_with_beam(bool below) {
    SceneBuilder b;
    const auto paint = b.add_material(glm::vec3(0.7F));
    const auto wood = b.add_material(glm::vec3(0.3F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 1, 1, paint);     // floor
    b.add_quad({-2, 0, -2}, {0, 2.5F, 0}, {0, 0, 4}, 1, 1, paint);  // walls
    b.add_quad({2, 0, -2}, {0, 0, 4}, {0, 2.5F, 0}, 1, 1, paint);
    b.add_quad({-2, 0, -2}, {4, 0, 0}, {0, 2.5F, 0}, 1, 1, paint);
    b.add_quad({-2, 0, 2}, {0, 2.5F, 0}, {4, 0, 0}, 1, 1, paint);
    if (below) {
        b.add_quad({-2, 2.5F, -2}, {4, 0, 0}, {0, 0, 4}, 1, 1, paint);  // ceiling
    } else {
        b.add_quad({-2, 2.5F, -2}, {1.9F, 0, 0}, {0, 0, 4}, 1, 1, paint);
        b.add_quad({0.1F, 2.5F, -2}, {1.9F, 0, 0}, {0, 0, 4}, 1, 1, paint);
    }
    b.add_quad({-0.1F, 2.1F, -2}, {0, 0, 4}, {0, 0.4F, 0}, 1, 1, wood);  // beam
    b.add_quad({0.1F, 2.1F, -2}, {0, 0.4F, 0}, {0, 0, 4}, 1, 1, wood);
    b.add_quad({-0.1F, 2.1F, -2}, {0.2F, 0, 0}, {0, 0, 4}, 1, 1, wood);
    b.add_quad({1.99F, 1, -0.5F}, {0, 0, 1}, {0, 1, 0}, 2, 2, lamp);
    return b.loaded_scene();
}

/// The upper half of the beam's dark side, from straight ahead.
Camera at_the_beam() {
    Camera camera;
    camera.eye = {-1.1F, 2.4F, 0.0F};
    camera.target = {-0.1F, 2.4F, 0.0F};
    camera.vertical_fov = 2.0F * std::atan(0.098F);
    return camera;
}

TessellationSettings coarse() {
    TessellationSettings settings;
    settings.patch_size = 0.7F;  // m, much more than what the picture shows
    return settings;
}

double mean_of_rows(const auto& pixels) {
    double sum = 0.0;
    for (unsigned i = 0; i < rows * size.x; ++i) {
        sum += double{pixels[i].x};
    }
    return sum / (rows * size.x);
}

/// What the rows show by path tracing; found once for each room.
double true_mean_of_rows(bool below) {
    static std::map<bool, double> known;
    const auto [entry, is_new] = known.try_emplace(below);
    if (is_new) {
        Scene scene = room_with_beam(below);
        const PatchMesh mesh = tessellate(scene, coarse());
        entry->second = mean_of_rows(path_traced_centres(scene, mesh, at_the_beam(), size, 1024));
    }
    return entry->second;
}

class BesideABrightCeiling : public testing::TestWithParam<Beam> {};

TEST_P(BesideABrightCeiling, ABeamGetsTheLightOfItsDarkEnd) {
    Scene scene = room_with_beam(GetParam().below);
    const PatchMesh mesh = tessellate(scene, coarse());
    SolverSettings settings;
    settings.probabilities = GetParam().strategies;
    settings.coarse_iterations = 1'000'000;
    Solver solver(scene, mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(at_the_beam());
    image.rest();
    BundleReceiver* const receivers[] = {&image};
    for (std::uint64_t i = 0; i < iterations; ++i) {
        solver.step(receivers);
    }
    // Within patches of this size light does not change linearly. Without slopes 1.06 and 1.05 are
    // found.
    EXPECT_NEAR(mean_of_rows(image.read_radiance()) / true_mean_of_rows(GetParam().below), 1.0,
                0.04);
}

constexpr StrategyProbabilities layered{1.0F, 0.0F, 0.0F};

INSTANTIATE_TEST_SUITE_P(Beams, BesideABrightCeiling,
                         testing::Values(Beam{"Layered", layered}, Beam{"CombinedBelow", {}, true}),
                         [](const testing::TestParamInfo<Beam>& beam) { return beam.param.name; });
INSTANTIATE_TEST_SUITE_P(HeavyBeams, BesideABrightCeiling,
                         testing::Values(Beam{"Combined"}, Beam{"LayeredBelow", layered, true}),
                         [](const testing::TestParamInfo<Beam>& beam) { return beam.param.name; });

}  // namespace
}  // namespace raybundle::radiance_slope_test
