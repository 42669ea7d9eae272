// SPDX-License-Identifier: Apache-2.0
// The first pictures of a solve: rough, but not black where light will come by reflection.
#include <gtest/gtest.h>

#include <vector>

#include "oracle/scene_builder.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::early_picture_test {
namespace {

const glm::uvec2 size(64, 48);
constexpr double lamp_luminance = 400.0;  // cd/m²: brighter are lamps alone

struct View {
    SceneBuilder builder;
    Camera camera;
};

/// A lamp that shines down: ceiling and the space below a table get reflected light alone.
View lamp_room() {
    View view;
    SceneBuilder& b = view.builder;
    const auto wall = b.add_material(glm::vec3(0.6F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 12, wall);
    b.add_quad({1.5F, 2.9F, 2}, {1, 0, 0}, {0, 0, 1}, 4, 4, lamp);
    b.add_box({1.6F, 0.9F, 2.5F}, {2.4F, 1.0F, 3.7F}, false, 4, wall);
    view.camera.eye = {0.5F, 1.8F, 0.5F};
    view.camera.target = {2.6F, 1.4F, 4.0F};
    view.camera.vertical_fov = 1.4F;
    return view;
}

/// A lamp that shines at the ceiling from a cove, and a coloured wall.
View cove_room() {
    View view;
    SceneBuilder& b = view.builder;
    const auto wall = b.add_material(glm::vec3(0.7F, 0.5F, 0.4F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(500.0F));
    b.add_box({0, 0, 0}, {6, 2.6F, 4}, true, 10, wall);
    b.add_quad({0.5F, 2.2F, 0.2F}, {0, 0, 0.2F}, {5, 0, 0}, 2, 20, lamp);
    view.camera.eye = {5.5F, 1.6F, 3.6F};
    view.camera.target = {0.5F, 1.2F, 1.0F};
    view.camera.vertical_fov = 1.2F;
    return view;
}

/// A room without its front, a lamp near it: most of the light is far from what the camera sees.
View open_room() {
    View view;
    SceneBuilder& b = view.builder;
    const auto wall = b.add_material(glm::vec3(0.7F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_quad({0, 0, 0}, {0, 0, 8}, {4, 0, 0}, 10, 10, wall);
    b.add_quad({0, 3, 0}, {4, 0, 0}, {0, 0, 8}, 10, 10, wall);
    b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 8}, 8, 12, wall);
    b.add_quad({4, 0, 0}, {0, 0, 8}, {0, 3, 0}, 12, 8, wall);
    b.add_quad({0, 0, 8}, {0, 3, 0}, {4, 0, 0}, 8, 10, wall);
    b.add_quad({1.5F, 2.9F, 1}, {1, 0, 0}, {0, 0, 1}, 4, 4, lamp);
    view.camera.eye = {2.0F, 1.6F, 3.0F};
    view.camera.target = {2.0F, 1.4F, 8.0F};
    view.camera.vertical_fov = 1.2F;
    return view;
}

std::vector<double> picture_after(const View& view, std::uint64_t seed, int iterations) {
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = {128, 300};
    settings.coarse_iterations = 1'000'000;
    Solver solver(view.builder.scene, view.builder.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(view.camera);
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < iterations; ++i) {
        solver.step(receivers);
    }
    std::vector<double> result;
    for (const glm::vec4& pixel : image.read_radiance()) {
        result.push_back(static_cast<double>(pixel.g));
    }
    return result;
}

class EarlyPicture : public testing::TestWithParam<View (*)()> {};

/// Sums over squares of 8x8 pixels, lamps left out: the luck of single pixels tells nothing.
std::vector<double> squares(const std::vector<double>& picture, const std::vector<double>& truth) {
    constexpr unsigned edge = 8;
    std::vector<double> sums(std::size_t{size.x / edge} * (size.y / edge), 0.0);
    for (unsigned i = 0; i < picture.size(); ++i) {
        const unsigned x = i % size.x / edge;
        const unsigned y = i / size.x / edge;
        sums[y * (size.x / edge) + x] += truth[i] < lamp_luminance ? picture[i] : 0.0;
    }
    return sums;
}

TEST_P(EarlyPicture, IsNowhereBlackAndAsBrightAsItWillBe) {
    const View view = GetParam()();
    const std::vector<double> truth = picture_after(view, 99, 1500);
    const std::vector<double> parts = squares(truth, truth);
    double shown = 0.0;
    double sum = 0.0;
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
        const std::vector<double> first = squares(picture_after(view, seed, 8), truth);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            EXPECT_GE(first[i], 0.3 * parts[i]) << "square " << i << ", seed " << seed;
            shown += first[i];
            sum += parts[i];
        }
    }
    EXPECT_NEAR(shown / sum, 1.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Rooms, EarlyPicture, testing::Values(&lamp_room, &cove_room, &open_room));

}  // namespace
}  // namespace raybundle::early_picture_test
