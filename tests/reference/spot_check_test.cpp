// SPDX-License-Identifier: Apache-2.0
// The true error of pictures by path tracing some pixels, where the error is known.
#include "reference/spot_check.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "rooms.h"

namespace raybundle {
namespace {

constexpr float albedo = 0.6F;
constexpr float sky = 100.0F;

/// A floor under a uniform sky, whose radiance is known: what a check errs by is its choice of
/// pixels.
SceneBuilder open_floor() {
    SceneBuilder b;
    const auto paint = b.add_material(glm::vec3(albedo));
    b.add_quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}, 1, 1, paint);
    b.scene.sky_radiance = glm::vec3(sky);
    return b;
}

Camera from_above() {
    Camera camera;
    camera.eye = {0.0F, 5.0F, 0.0F};
    camera.target = {0.3F, 0.0F, 0.1F};
    camera.vertical_fov = 1.0F;
    return camera;
}

Camera in_enclosure() {
    Camera camera;
    camera.eye = glm::vec3(odd_rotation() * glm::vec4(2.0F, 2.0F, 0.2F, 1.0F));
    camera.target = glm::vec3(odd_rotation() * glm::vec4(1.8F, 1.2F, 4.0F, 1.0F));
    camera.vertical_fov = 1.4F;
    return camera;
}

std::shared_ptr<const TracedScene> traced(const SceneBuilder& b) {
    return std::make_shared<const TracedScene>(b.scene, b.mesh);
}

double relative_square(std::span<const glm::vec4> picture, double truth) {
    double sum = 0.0;
    for (const glm::vec4& p : picture) {
        const glm::dvec3 d = glm::dvec3(p) - truth;
        sum += glm::dot(d, d);
    }
    return sum / (3.0 * truth * truth * static_cast<double>(picture.size()));
}

/// A picture of the floor, wrong by a few percent everywhere and by more in a few places.
std::vector<glm::vec4> wrong_picture(glm::uvec2 size) {
    std::vector<glm::vec4> picture(std::size_t{size.x} * size.y);
    RandomStream random(11, 0);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const double wave = 0.03 * std::sin(0.05 * static_cast<double>(i % size.x));
        const double speck = random.next() < 0.02 ? 0.2 : 0.0;
        picture[i] = glm::vec4(glm::vec3(albedo * sky) * static_cast<float>(1.0 + wave + speck), 1);
    }
    return picture;
}

/// The squared error comes out right in the mean, and as far off as its standard error says: over
/// 64 checks of one picture, each of its own pixels and paths.
TEST(SpotCheck, MeasuresTheTrueErrorOfALargePicture) {
    constexpr glm::uvec2 size(320, 200);
    constexpr int checks = 64;
    const SceneBuilder b = open_floor();
    const std::vector<glm::vec4> picture = wrong_picture(size);
    const double truth = relative_square(picture, double{albedo} * sky);
    double mean = 0.0;
    double squares = 0.0;
    int inside = 0;
    for (int i = 0; i < checks; ++i) {
        SpotCheck check(traced(b), from_above(), size, 100 + static_cast<std::uint64_t>(i));
        check.add_round();
        const SquaredError found = check.measure(picture);
        const double z = (found.value - truth) / found.standard_error;
        mean += (found.value / truth - 1.0) / checks;
        squares += z * z / checks;
        inside += std::abs(z) < 1.96 ? 1 : 0;
        EXPECT_LT(found.standard_error, 0.3 * truth);
        EXPECT_LT(check.pixels(), 2000U);
    }
    EXPECT_LT(std::abs(mean), 5.0 * 0.3 / std::sqrt(checks));
    EXPECT_GT(squares, 0.5);  // chi-square of 64: 5 sigma are 0.88 about 1
    EXPECT_LT(squares, 1.9);
    EXPECT_GE(inside, 54);  // of 64; 95 % less 4 sigma
}

/// Three sparks hold nearly all of the error: a choice of pixels by chance seldom has one.
TEST(SpotCheck, FindsTheFewPixelsThatHoldMostOfTheError) {
    constexpr glm::uvec2 size(320, 200);
    const SceneBuilder b = open_floor();
    std::vector<glm::vec4> picture = wrong_picture(size);
    for (const std::size_t pixel : {1234U, 33333U, 33334U}) {
        picture[pixel] *= 100.0F;
    }
    const double truth = relative_square(picture, double{albedo} * sky);
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        SpotCheck check(traced(b), from_above(), size, seed);
        check.add_round();
        const std::size_t chosen = check.pixels();
        check.look_for_sparks(picture);
        EXPECT_EQ(check.pixels(), chosen + 128);
        const SquaredError found = check.measure(picture);
        EXPECT_NEAR(found.value, truth, 4.0 * found.standard_error + 1e-6 * truth);
        EXPECT_LT(found.standard_error, 0.05 * truth);  // of the light that it is relative to
        check.look_for_sparks(picture);                 // the same
        EXPECT_EQ(check.pixels(), chosen + 128);
    }
}

/// Sparks of one picture are measured in the next as well, where they are nothing special.
TEST(HeavySpotCheck, StaysUnbiasedWhereSparksWereInAnotherPicture) {
    constexpr glm::uvec2 size(320, 200);
    constexpr int checks = 64;
    const SceneBuilder b = open_floor();
    const std::vector<glm::vec4> picture = wrong_picture(size);
    std::vector<glm::vec4> earlier = picture;
    for (std::size_t i = 0; i < earlier.size(); i += 500) {
        earlier[i] *= 50.0F;
    }
    const double truth = relative_square(picture, double{albedo} * sky);
    double mean = 0.0;
    for (int i = 0; i < checks; ++i) {
        SpotCheck check(traced(b), from_above(), size, 100 + static_cast<std::uint64_t>(i));
        check.add_round();
        check.look_for_sparks(earlier);
        mean += (check.measure(picture).value / truth - 1.0) / checks;
    }
    EXPECT_LT(std::abs(mean), 5.0 * 0.3 / std::sqrt(checks));
}

/// Paths of a room are noisy; a picture that is as they say in the mean has no error to be found,
/// and one that is 5 % too dark has that.
TEST(SpotCheck, FindsWhatIsMissingThroughTheNoiseOfItsPaths) {
    constexpr glm::uvec2 size(40, 30);
    const SceneBuilder b = enclosure(0.5F);
    const RayScene scene(b.scene, b.mesh);
    const LightSampling lights(scene);
    const PathTracer tracer(scene, lights);
    const CameraRays rays(scene, in_enclosure(), size);
    ImageEstimate reference(size, 5);
    for (int i = 0; i < 1024; ++i) {
        reference.add_pass(rays, [&](const glm::dvec3& origin, const glm::dvec3& direction,
                                     PixelSampler& sampler) {
            return tracer.radiance(origin, direction, sampler);
        });
    }
    const double noise = reference.error({}).relative;
    SpotCheck check(traced(b), in_enclosure(), size, 9);
    for (int round = 0; round < 4; ++round) {
        check.add_round();
    }
    for (const double darker : {0.0, 0.05, 0.2}) {
        std::vector<glm::vec4> picture;
        for (const glm::dvec3& mean : reference.means()) {
            picture.emplace_back(glm::vec3((1.0 - darker) * mean), 1.0F);
        }
        const SquaredError found = check.measure(picture);
        const double truth = darker * darker + (1.0 - darker) * (1.0 - darker) * noise * noise;
        EXPECT_NEAR(found.value, truth, 4.0 * found.standard_error) << darker;
        EXPECT_LT(found.standard_error, 0.0005 + 0.15 * darker * darker) << darker;
    }
}

TEST(SpotCheck, KnowsNothingWithoutPathsOrPixels) {
    constexpr glm::uvec2 size(8, 8);
    const SceneBuilder b = enclosure(0.5F);
    const std::vector<glm::vec4> picture(std::size_t{size.x} * size.y, glm::vec4(1.0F));
    const SpotCheck none(traced(b), in_enclosure(), size, 1);
    EXPECT_TRUE(std::isinf(none.measure(picture).standard_error));
    const SceneBuilder lamps = furnace_room(0.5F, 10.0F);  // every pixel sees an emitter
    Camera camera = in_enclosure();
    SpotCheck empty(traced(lamps), camera, size, 1);
    empty.add_round();
    EXPECT_EQ(empty.pixels(), 0U);
    EXPECT_TRUE(std::isinf(empty.measure(picture).standard_error));
}

/// Nothing depends on the number of threads.
TEST(SpotCheck, ComesOutTheSameWithAnyNumberOfThreads) {
    constexpr glm::uvec2 size(20, 15);
    const SceneBuilder b = enclosure(0.8F);
    const std::vector<glm::vec4> picture(std::size_t{size.x} * size.y, glm::vec4(50.0F));
    std::vector<SquaredError> found;
    for (const int threads : {1, 4}) {
        tbb::task_arena arena(threads);
        arena.execute([&] {
            SpotCheck check(traced(b), in_enclosure(), size, 3);
            check.add_round();
            found.push_back(check.measure(picture));
        });
    }
    EXPECT_EQ(found[0].value, found[1].value);
    EXPECT_EQ(found[0].standard_error, found[1].standard_error);
}

/// Sunlight through a window pane is light, not an error of the picture that shows it: two faces of
/// an index of 1.5 let (1 - r)/(1 + r) through, r = 0.04.
TEST(SpotCheck, SunThroughAPaneIsNoError) {
    SceneBuilder b;
    b.add_quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}, 1, 1, b.add_material(glm::vec3(albedo)));
    Material glass;
    glass.base_colour = glm::vec3(1.0F);
    glass.metallic = 0.0F;
    glass.roughness = 0.0F;
    glass.transmission = 1.0F;
    glass.double_sided = true;
    b.add_quad({-10, 8, -10}, {0, 0, 20}, {20, 0, 0}, 1, 1, b.add_material(glass));
    PunctualLight sun;
    sun.kind = PunctualKind::directional;
    sun.axes[2] = glm::vec3(0, 1, 0);
    sun.axes[0] = glm::vec3(1, 0, 0);
    sun.axes[1] = glm::vec3(0, 0, -1);
    sun.intensity = glm::vec3(1000.0F);
    b.scene.punctual_lights.push_back(sun);
    const float radiance = albedo * 1000.0F * (0.96F / 1.04F) / glm::pi<float>();
    const glm::uvec2 size(64, 48);
    const std::vector<glm::vec4> picture(std::size_t{size.x} * size.y,
                                         glm::vec4(glm::vec3(radiance), 1.0F));
    SpotCheck check(traced(b), from_above(), size, 3);
    for (int i = 0; i < 4; ++i) {
        check.add_round();
    }
    // The floor's own light comes back from the pane, 0.08 of 0.6 of it: less than a tenth of what
    // was counted as error before, all of it.
    EXPECT_LT(std::sqrt(std::max(check.measure(picture).value, 0.0)), 0.1);
}

}  // namespace
}  // namespace raybundle
