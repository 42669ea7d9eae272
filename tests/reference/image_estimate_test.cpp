// SPDX-License-Identifier: Apache-2.0
#include "reference/measures/image_estimate.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "reference/measures/emitter_pixels.h"
#include "rooms.h"

namespace raybundle {
namespace {

constexpr glm::uvec2 picture_size(24, 16);

Camera room_camera() {
    Camera camera;
    camera.eye = glm::vec3(odd_rotation() * glm::vec4(2.0F, 2.0F, 0.2F, 1.0F));
    camera.target = glm::vec3(odd_rotation() * glm::vec4(1.8F, 2.2F, 4.0F, 1.0F));
    camera.vertical_fov = 1.4F;
    return camera;
}

struct View {
    explicit View(const SceneBuilder& builder)
        : tracing(builder), camera(tracing.scene, room_camera(), picture_size) {}

    ImageEstimate render(int passes, std::uint64_t seed, int threads) const {
        ImageEstimate image(picture_size, seed);
        tbb::task_arena arena(threads);
        arena.execute([&] {
            for (int i = 0; i < passes; ++i) {
                image.add_pass(camera, estimator());
            }
        });
        return image;
    }

    [[nodiscard]] RadianceEstimator estimator() const {
        return
            [this](const glm::dvec3& origin, const glm::dvec3& direction, PixelSampler& sampler) {
                return tracing.tracer.radiance(origin, direction, sampler);
            };
    }

    Tracing tracing;
    CameraRays camera;
};

bool same_bits(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            if (std::bit_cast<std::uint64_t>(a[i][c]) != std::bit_cast<std::uint64_t>(b[i][c])) {
                return false;
            }
        }
    }
    return a.size() == b.size();
}

TEST(ImageEstimate, SameSeedGivesTheSameBitsWithAnyNumberOfThreads) {
    const SceneBuilder room = enclosure(0.8F);
    const View view(room);
    const auto one = view.render(5, 7, 1).means();
    EXPECT_TRUE(same_bits(one, view.render(5, 7, 2).means()));
    EXPECT_FALSE(same_bits(one, view.render(5, 8, 2).means()));
}

TEST(ImageEstimate, FurnaceIsAConstantPicture) {
    const SceneBuilder room = furnace_room(0.5F, 100.0F);
    Camera camera;
    camera.eye = glm::vec3(odd_rotation() * glm::vec4(0.5F, 1.5F, 0.5F, 1.0F));
    camera.target = glm::vec3(odd_rotation() * glm::vec4(3.0F, 1.2F, 1.5F, 1.0F));
    const Tracing tracing(room);
    const CameraRays rays(tracing.scene, camera, picture_size);
    ImageEstimate image(picture_size, 3);
    for (int i = 0; i < 256; ++i) {
        image.add_pass(rays, [&](const glm::dvec3& o, const glm::dvec3& d, PixelSampler& s) {
            return tracing.tracer.radiance(o, d, s);
        });
    }
    double sum = 0.0;
    for (const glm::dvec3& pixel : image.means()) {
        EXPECT_NEAR(pixel.g, 200.0, 10.0);
        sum += pixel.g;
    }
    EXPECT_NEAR(sum / (picture_size.x * picture_size.y), 200.0, 0.2);
    EXPECT_EQ(image.non_finite(), 0U);
}

/// Deviations from a long run in units of the estimated standard error are t-distributed with 7
/// degrees of freedom: 5 % beyond 2.365. Of 384 pixels (nearly independent) between 1.5 % and 10 %
/// may be: 4.5 sigma of that share.
TEST(HeavyImageEstimate, StandardErrorsAreCalibrated) {
    const SceneBuilder room = enclosure(0.8F);
    const View view(room);
    const ImageEstimate reference = view.render(4096, 1, 2);
    const ImageEstimate image = view.render(64, 2, 2);
    int beyond = 0;
    double squares = 0.0;
    double expected = 0.0;
    for (std::size_t i = 0; i < reference.means().size(); ++i) {
        const double deviation = image.mean(i).g - reference.mean(i).g;
        const double error = image.standard_error(i).g;
        beyond += std::abs(deviation) > 2.365 * error ? 1 : 0;
        squares += deviation * deviation;
        expected += error * error;
    }
    const double share = beyond / static_cast<double>(picture_size.x * picture_size.y);
    EXPECT_GT(share, 0.0);
    EXPECT_LT(share, 0.10);
    EXPECT_NEAR(std::sqrt(squares / expected), 1.0, 0.25);
}

TEST(ImageEstimate, ErrorIsUnknownUntilEveryBatchHasASample) {
    const SceneBuilder room = enclosure(0.5F);
    const View view(room);
    EXPECT_TRUE(std::isinf(view.render(7, 1, 2).standard_error(0).g));
    EXPECT_EQ(view.render(7, 1, 2).error({}).relative, 1.0);
    EXPECT_LT(view.render(64, 1, 2).error({}).relative, 0.5);
}

TEST(ImageEstimate, DropsAndCountsWhatIsNotFinite) {
    const SceneBuilder room = enclosure(0.5F);
    const View view(room);
    ImageEstimate image({2, 2}, 1);
    const CameraRays rays(view.tracing.scene, room_camera(), {2, 2});
    const RadianceEstimator broken = [](const glm::dvec3&, const glm::dvec3&, PixelSampler&) {
        return glm::dvec3(1.0, std::numeric_limits<double>::infinity(), 1.0);
    };
    image.add_pass(rays, broken);
    EXPECT_EQ(image.non_finite(), 4U);
    EXPECT_EQ(image.mean(3), glm::dvec3(0.0));
}

TEST(EmitterPixels, AreThoseWhoseAreaShowsAnEmitterAndTheirNeighboursAreNotMeasured) {
    const SceneBuilder room = enclosure(0.5F);
    const View view(room);
    Camera up;
    up.eye = glm::vec3(odd_rotation() * glm::vec4(1.5F, 1.0F, 1.5F, 1.0F));
    up.target = glm::vec3(odd_rotation() * glm::vec4(1.5F, 4.0F, 1.5F, 1.0F));
    up.up = glm::vec3(odd_rotation() * glm::vec4(0.0F, 0.0F, 1.0F, 0.0F));
    up.vertical_fov = 2.0F * std::atan(0.5F);  // shows 3 m of the ceiling
    // The lamp covers the middle third: pixels 4..7 of 12 and what overlaps by rounding.
    const CameraRays rays(view.tracing.scene, up, {12, 12});
    const std::vector<bool> measured = measured_pixels(view.tracing.scene, rays);
    for (unsigned y = 0; y < 12; ++y) {
        for (unsigned x = 0; x < 12; ++x) {
            const bool inside = x >= 4 && x < 8 && y >= 4 && y < 8;
            const bool near = x >= 3 && x < 9 && y >= 3 && y < 9;
            const std::size_t pixel = std::size_t{12} * y + x;
            EXPECT_EQ(pixel_sees_emitter(view.tracing.scene, rays, pixel), inside)
                << x << ", " << y;
            EXPECT_EQ(pixel_is_measured(view.tracing.scene, rays, {x, y}), !near) << x << ", " << y;
            EXPECT_EQ(measured[pixel], !near) << x << ", " << y;
        }
    }
}

Material smooth_material(float metallic, float transmission) {
    Material material;
    material.base_colour = glm::vec3(0.9F);
    material.metallic = metallic;
    material.roughness = 0.0F;
    material.transmission = transmission;
    return material;
}

/// The lamp seen from 1 m above the floor's middle, or from there the floor below.
Camera vertical_camera(bool up) {
    Camera camera;
    const auto place = [](float x, float y, float z) {
        return glm::vec3(odd_rotation() * glm::vec4(x, y, z, 1.0F));
    };
    camera.eye = place(1.5F, 1.0F, 1.5F);
    camera.target = place(1.5F, up ? 4.0F : 0.0F, 1.5F);
    camera.up = place(0.0F, 0.0F, 1.0F);
    camera.vertical_fov = 2.0F * std::atan(0.5F);
    return camera;
}

TEST(EmitterPixels, SeenThroughAPaneAreThoseThatAreSeenDirectly) {
    const SceneBuilder room = enclosure(0.5F);
    SceneBuilder glazed = enclosure(0.5F);
    glazed.add_quad({0, 2, 0}, {4, 0, 0}, {0, 0, 4}, 1, 1,
                    add_material(glazed, smooth_material(0.0F, 1.0F)));
    const View direct(room);
    const View through(glazed);
    const Camera up = vertical_camera(true);
    const auto expected =
        measured_pixels(direct.tracing.scene, CameraRays(direct.tracing.scene, up, {12, 12}));
    EXPECT_TRUE(std::count(expected.begin(), expected.end(), false) > 0);
    EXPECT_EQ(
        measured_pixels(through.tracing.scene, CameraRays(through.tracing.scene, up, {12, 12})),
        expected);
}

TEST(EmitterPixels, SeenInAMirrorCountAsSeenDirectly) {
    SceneBuilder room = enclosure(0.5F);
    room.add_quad({0, 0.5F, 0}, {0, 0, 4}, {4, 0, 0}, 1, 1,
                  add_material(room, smooth_material(1.0F, 0.0F)));
    const View view(room);
    const CameraRays rays(view.tracing.scene, vertical_camera(false), {12, 12});
    // The lamp's image covers the middle quarter: 4 m away, where 4 m are shown.
    EXPECT_TRUE(pixel_sees_emitter(view.tracing.scene, rays, std::size_t{6} * 12 + 6));
    EXPECT_FALSE(pixel_is_measured(view.tracing.scene, rays, {6, 6}));
    EXPECT_FALSE(pixel_sees_emitter(view.tracing.scene, rays, std::size_t{2} * 12 + 6));
    EXPECT_TRUE(pixel_is_measured(view.tracing.scene, rays, {6, 2}));
}

}  // namespace
}  // namespace raybundle
