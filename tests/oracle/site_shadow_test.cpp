// SPDX-License-Identifier: Apache-2.0
// Shadows of fine things on large grounds: as sharp as on small ones, at every pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../reference/lit_room.h"
#include "pictures.h"
#include "scene/gltf/gltf_loader.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::site_shadow_test {
namespace {

constexpr glm::uvec2 size(32, 24);

/// Bars of 40 mm with gaps of 60 mm, 2 m high, along x.
std::vector<Bounds> fence() {
    std::vector<Bounds> bars;
    for (int i = -30; i < 30; ++i) {
        const float x = 0.1F * static_cast<float>(i);
        bars.push_back({{x, 0.0F, -0.01F}, {x + 0.04F, 2.0F, 0.01F}});
    }
    return bars;
}

/// Whether the way from a point along a vector, up to its end or without end, meets a box.
bool meets(const Bounds& box, const glm::dvec3& from, const glm::dvec3& way, bool endless) {
    double enter = 0.0;
    double leave = endless ? 1e30 : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (static_cast<double>(box.min[axis]) - from[axis]) / way[axis];
        const double b = (static_cast<double>(box.max[axis]) - from[axis]) / way[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter < leave;
}

struct Shadow {
    int pixels = 0;  ///< on the ground that a light could reach
    int wrong = 0;
    int lit = 0;
    int lit_in_truth = 0;
};

/// A black fence on a black ground of so many metres, seen from a place.
Shadow shadow_of_fence(PunctualKind kind, float ground, const glm::vec3& eye,
                       const glm::vec3& target) {
    SceneBuilder b;
    const auto black = b.add_material(glm::vec3(0.0F));
    const float half = 0.5F * ground;
    b.add_quad({-half, 0, -half}, {0, 0, ground}, {ground, 0, 0}, 1, 1, black);
    for (const Bounds& bar : fence()) {
        b.add_box(bar.min, bar.max, false, 1, black);
    }
    const glm::vec3 lamp(0.23F, 2.7F, 2.9F);
    add_punctual_light(b, glm::mat4(1.0F), kind, lamp, glm::vec3(0, -1, -1), glm::vec3(1000.0F));
    const Solver solver(b.scene, b.mesh);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.vertical_fov = 2.5F / glm::distance(eye, target);  // shows 2.5 m
    image.set_camera(camera);
    const bool sun = kind == PunctualKind::directional;
    Shadow shadow;
    for (std::uint32_t i = 0; i < size.x * size.y; ++i) {
        const auto probe = image.probe({i % size.x, i / size.x});
        const glm::dvec3 at = probe ? glm::dvec3(probe->position) : glm::dvec3(0, 1, 0);
        const glm::dvec3 way = sun ? glm::dvec3(0, 1, 1) : glm::dvec3(lamp) - at;
        const double off_axis = (way.y + way.z) / (std::sqrt(2.0) * glm::length(way));
        if (std::abs(at.y) > 1e-3 ||
            (kind == PunctualKind::spot && off_axis < std::cos(glm::radians(34.0)))) {
            continue;
        }
        const std::vector<Bounds> bars = fence();
        const bool hidden = std::any_of(
            bars.begin(), bars.end(), [&](const Bounds& bar) { return meets(bar, at, way, sun); });
        const bool lit = probe->irradiance.g > 0.0F;
        ++shadow.pixels;
        shadow.wrong += lit == hidden ? 1 : 0;
        shadow.lit += lit ? 1 : 0;
        shadow.lit_in_truth += hidden ? 0 : 1;
    }
    return shadow;
}

class SiteShadow : public testing::TestWithParam<std::tuple<PunctualKind, float>> {};

TEST_P(SiteShadow, OfAFenceIsExactNearAndFar) {
    const auto [kind, ground] = GetParam();
    const std::pair<glm::vec3, glm::vec3> views[] = {{{0.3F, 1.7F, -3.5F}, {0, 0, -0.6F}},
                                                     {{4, 19, -30}, {0, 0, -1}}};
    for (const auto& [eye, target] : views) {
        const Shadow shadow = shadow_of_fence(kind, ground, eye, target);
        ASSERT_GT(shadow.pixels, 60);
        EXPECT_LE(shadow.wrong, shadow.pixels / 100) << shadow.pixels;
        EXPECT_NEAR(shadow.lit, shadow.lit_in_truth, 0.02 * shadow.pixels);
        EXPECT_LT(shadow.lit_in_truth, shadow.pixels);
    }
}

INSTANTIATE_TEST_SUITE_P(Grounds, SiteShadow,
                         testing::Combine(testing::Values(PunctualKind::directional,
                                                          PunctualKind::spot, PunctualKind::point),
                                          testing::Values(10.0F, 300.0F, 2000.0F)));

/// Lights are added some at a time; how many there are makes no difference.
TEST(FirstShot, ManyLightsBringTheSumOfTheirLight) {
    const auto brought_by = [](int lights) {
        SceneBuilder b;
        b.add_box({0, 0, 0}, {4, 3, 5}, true, 4, b.add_material(glm::vec3(0.0F)));
        b.add_box({1, 0, 1}, {2, 1, 2}, false, 2, b.add_material(glm::vec3(0.0F)));
        for (int i = 0; i < lights; ++i) {
            add_punctual_light(b, glm::mat4(1.0F), PunctualKind::point, {1.1F, 2.3F, 1.9F},
                               {0, -1, 0}, glm::vec3(640.0F / static_cast<float>(lights)));
        }
        const Solver solver(b.scene, b.mesh);
        return solver.store().read_irradiance();
    };
    const auto one = brought_by(1);
    const auto many = brought_by(40);
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_NEAR(many[i].g, one[i].g, 1e-4F * one[i].g + 1e-5F);
    }
}

/// Compares with path tracing: blocks of 6 x 6 pixels, the mean of what the sun shines on, which is
/// exact but for what else lights it, and the mean of all, to a bound of its own.
void expect_as_by_paths(const std::string& file, const Camera& camera, double bound,
                        double bound_of_mean) {
    Scene scene = load_gltf(std::string(RAYBUNDLE_CASES) + "/places/" + file);
    TessellationSettings tessellation;
    tessellation.target_patches = 3000;
    const PatchMesh mesh = tessellate(scene, tessellation);
    Solver solver(scene, mesh);
    const ViewPrograms programs(solver.scene());
    constexpr glm::uvec2 view(48, 36);
    ViewerImage image(solver.scene(), solver.store(), programs, view);
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 200; ++i) {
        solver.step(receivers);
    }
    const auto picture = image.read_radiance();
    const auto truth = path_traced_centres(scene, mesh, camera, view, 256);
    EXPECT_LT(block_difference(picture, truth, view, 6), bound);
    double most = 0.0;
    for (const auto& pixel : truth) {
        most = std::max(most, pixel.g);
    }
    double shown = 0.0;
    double exact = 0.0;
    double shown_of_sun = 0.0;
    double exact_of_sun = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double pixel = truth[i].g >= 0.0 ? static_cast<double>(picture[i].g) : 0.0;
        shown += pixel;
        exact += std::max(truth[i].g, 0.0);
        if (truth[i].g > 0.5 * most) {
            shown_of_sun += pixel;
            exact_of_sun += truth[i].g;
        }
    }
    EXPECT_NEAR(shown_of_sun, exact_of_sun, 0.02 * exact_of_sun);
    EXPECT_NEAR(shown, exact, bound_of_mean * exact) << shown / exact;
}

TEST(CasesSunOnASite, BarsThrowBarsOnAGroundOf300Metres) {
    Camera camera;
    camera.eye = {0, 1.6F, 3.5F};
    camera.target = {0, 0, -1.2F};
    expect_as_by_paths("fence300.gltf", camera, 0.05, 0.02);
}

TEST(CasesSunOnASite, APatchOfSunIsWholeOnAGroundOf300Metres) {
    Camera camera;
    camera.eye = {4.5F, 2.2F, 4.6F};
    camera.target = {2.2F, 0.2F, 1.5F};
    camera.vertical_fov = glm::radians(75.0F);
    // What the patch sends into the room scatters by 4 % of the mean from seed to seed.
    expect_as_by_paths("sun300.gltf", camera, 0.06, 0.12);
}

}  // namespace
}  // namespace raybundle::site_shadow_test
