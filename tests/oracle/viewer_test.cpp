// SPDX-License-Identifier: Apache-2.0
#include "view/viewer_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "oracle/scene_builder.h"
#include "transport/solver.h"
#include "view/camera_matrices.h"

namespace raybundle::viewer_test {
namespace {

constexpr float emission = 100.0F;

/// A closed room that emits everywhere: the picture is one constant, Le/(1 - albedo).
struct FurnaceView {
    explicit FurnaceView(float albedo, const StrategyProbabilities& probabilities = {},
                         int window = 800, glm::uvec2 size = {64, 48}) {
        const auto m = builder.add_material(glm::vec3(albedo), glm::vec3(emission));
        builder.add_box({0, 0, 0}, {4, 3, 5}, true, 6, m);
        SolverSettings settings;
        settings.probabilities = probabilities;
        settings.coarse = {256, window};
        settings.coarse_iterations = 1'000'000;
        solver.emplace(builder.scene, builder.mesh, settings);
        programs.emplace(solver->scene());
        image.emplace(solver->scene(), solver->store(), *programs, size);
        camera.eye = {0.5F, 1.5F, 0.5F};
        camera.target = {3.0F, 1.2F, 4.0F};
        camera.vertical_fov = 1.2F;
        image->set_camera(camera);
    }

    void iterate(int count) {
        BundleReceiver* const receivers[] = {&*image};
        for (int i = 0; i < count; ++i) {
            solver->step(receivers);
        }
    }

    SceneBuilder builder;
    std::optional<Solver> solver;
    std::optional<ViewPrograms> programs;
    std::optional<ViewerImage> image;
    Camera camera;
};

TEST(ViewerImage, FurnaceIsAConstantPicture) {
    FurnaceView view(0.5F);
    view.iterate(768);
    const double exact = static_cast<double>(emission) / 0.5;
    double mean = 0.0;
    for (const glm::vec4& pixel : view.image->read_radiance()) {
        mean += static_cast<double>(pixel.g) / (64.0 * 48.0);
        EXPECT_NEAR(static_cast<double>(pixel.g), exact, 0.08 * exact);
    }
    EXPECT_NEAR(mean, exact, 0.01 * exact);
}

/// Of patches alone, with nothing gathered.
TEST(PatchPicture, FurnaceIsAConstantPicture) {
    FurnaceView view(0.5F);
    for (int i = 0; i < 768; ++i) {
        view.solver->step({});
    }
    const ViewPrograms programs(view.solver->scene(), PixelLight::patches);
    ViewerImage image(view.solver->scene(), view.solver->store(), programs, {64, 48});
    image.set_camera(view.camera);
    const double exact = static_cast<double>(emission) / 0.5;
    for (const glm::vec4& pixel : image.read_radiance()) {
        EXPECT_NEAR(static_cast<double>(pixel.g), exact, 0.08 * exact);
    }
}

/// Light that is known at pixels otherwise: a punctual light's.
TEST(PatchPicture, HasTheFirstShotOfPunctualLights) {
    SceneBuilder builder;
    const auto floor = builder.add_material(glm::vec3(0.5F));
    builder.add_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 40, 40, floor);
    PunctualLight light;
    light.intensity = glm::vec3(100.0F);
    light.position = {0.0F, 2.0F, 0.0F};
    builder.scene.punctual_lights.push_back(light);
    Solver solver(builder.scene, builder.mesh);
    for (int i = 0; i < 16; ++i) {
        solver.step({});
    }
    const ViewPrograms programs(solver.scene(), PixelLight::patches);
    ViewerImage image(solver.scene(), solver.store(), programs, {32, 32});
    Camera camera;
    camera.eye = {0.3F, 1.0F, 0.2F};
    camera.target = {0.3F, 0.0F, 0.2F};
    camera.up = {0.0F, 0.0F, -1.0F};
    camera.vertical_fov = 0.05F;
    image.set_camera(camera);
    const double square = 0.3 * 0.3 + 0.2 * 0.2 + 4.0;
    const double exact = 0.5 / glm::pi<double>() * 100.0 * 2.0 / (square * std::sqrt(square));
    EXPECT_NEAR(static_cast<double>(image.read_radiance()[16 * 32 + 16].g), exact, 0.01 * exact);
}

/// Pixels that a plane bundle serves, alone and among all strategies: light within 1 % in the mean.
TEST(HeavyViewerImage, FurnaceIsAConstantPictureWithPlanes) {
    for (const StrategyProbabilities& p :
         {StrategyProbabilities{0.0F, 1.0F, 0.0F}, StrategyProbabilities{0.15F, 0.15F, 0.7F}}) {
        // Planes alone are noisy: a pixel's sample is 0 or large.
        const bool alone = p.plane == 1.0F;
        FurnaceView view(0.5F, p, 400);
        view.iterate(alone ? 3072 : 768);
        const double exact = static_cast<double>(emission) / 0.5;
        double mean = 0.0;
        double square = 0.0;
        for (const glm::vec4& pixel : view.image->read_radiance()) {
            const double error = static_cast<double>(pixel.g) / exact - 1.0;
            mean += error / (64.0 * 48.0);
            square += error * error / (64.0 * 48.0);
            EXPECT_LT(std::abs(error), alone ? 0.4 : 0.08);
        }
        EXPECT_LT(std::abs(mean), 0.01);
        EXPECT_LT(std::sqrt(square), alone ? 0.06 : 0.03);
    }
}

TEST(ViewerImage, EstimatedErrorIsOfTheSizeOfTheError) {
    const auto solve = [](std::uint64_t seed, int iterations, double& estimate) {
        SceneBuilder b;
        const auto wall = b.add_material(glm::vec3(0.6F));
        const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
        b.add_box({0, 0, 0}, {4, 3, 5}, true, 6, wall);
        b.add_quad({1.5F, 2.9F, 2}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
        SolverSettings settings;
        settings.seed = seed;
        settings.coarse = {128, 400};
        settings.coarse_iterations = 1'000'000;
        Solver solver(b.scene, b.mesh, settings);
        const ViewPrograms programs(solver.scene());
        ViewerImage image(solver.scene(), solver.store(), programs, {64, 48});
        Camera camera;
        camera.eye = {0.5F, 1.5F, 0.5F};
        camera.target = {3.0F, 0.5F, 4.0F};
        image.set_camera(camera);
        BundleReceiver* const receivers[] = {&image};
        for (int i = 0; i < iterations; ++i) {
            solver.step(receivers);
        }
        image.request_statistics();
        glFinish();
        estimate = image.statistics().relative_error;
        return image.read_radiance();
    };
    double ignored = 0.0;
    const auto truth = solve(77, 768, ignored);  // adds 6 % to the error that is found
    double estimate = 0.0;
    const auto picture = solve(1, 96, estimate);
    double square = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        square += std::pow(static_cast<double>(picture[i].g - truth[i].g), 2);
        total += std::pow(static_cast<double>(truth[i].g), 2);
    }
    const double error = std::sqrt(square / total);
    EXPECT_GT(estimate, error / 3.0);
    EXPECT_LT(estimate, error * 3.0);
}

TEST(ViewerImage, CameraThereAndBackShowsTheSamePicture) {
    FurnaceView view(0.5F);
    view.iterate(256);
    const auto before = view.image->read_radiance();
    Camera moved = view.camera;
    for (int i = 0; i < 8; ++i) {
        moved.eye.x += 0.05F;
        view.image->set_camera(moved);
    }
    view.image->set_camera(view.camera);
    const auto after = view.image->read_radiance();
    double difference = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        difference += std::abs(static_cast<double>(before[i].g - after[i].g)) / 200.0 /
                      static_cast<double>(before.size());
    }
    EXPECT_LT(difference, 0.02);
}

/// Share of pixels with more than so much weight.
double share_of_weights_above(const ViewerImage& image, float least) {
    const auto irradiance = image.read_irradiance();
    const auto kept = std::count_if(irradiance.begin(), irradiance.end(),
                                    [&](const glm::vec4& e) { return e.w > least; });
    return static_cast<double>(kept) / static_cast<double>(irradiance.size());
}

TEST(ViewerImage, DrawnSmallerItShowsTheSameWithItsLight) {
    FurnaceView view(0.5F);
    view.iterate(256);
    const float weight = view.image->read_irradiance().front().w;
    for (const glm::uvec2 size : {glm::uvec2(40, 30), glm::uvec2(53, 41), glm::uvec2(64, 48)}) {
        view.image->set_camera(view.camera, size);
        EXPECT_EQ(view.image->size(), size);
        EXPECT_EQ(view.image->full_size(), glm::uvec2(64, 48));
        // Each change of the camera takes a tenth.
        EXPECT_GT(share_of_weights_above(*view.image, 0.7F * weight), 0.95);
        view.iterate(16);
        const auto picture = view.image->read_radiance();
        ASSERT_EQ(picture.size(), std::size_t{size.x} * size.y);
        double error = 0.0;
        for (const glm::vec4& pixel : picture) {
            error += std::abs(static_cast<double>(pixel.g) / 200.0 - 1.0) /
                     static_cast<double>(picture.size());
        }
        EXPECT_LT(error, 0.02);
        view.image->compose(DisplayMode::photo, -7.0F);
        EXPECT_EQ(view.image->take().size(), std::size_t{size.x} * size.y * 4);
        // It reaches as far: corners of the picture are where they were.
        EXPECT_FALSE(view.image->smooth_step() && size.x < 64);
        const auto corner = view.image->probe({0, 0});
        ASSERT_TRUE(corner.has_value());
        const glm::vec2 pixel = 0.5F / glm::vec2(size) * glm::vec2(64, 48) - 0.5F;
        const glm::vec3 expected = pixel_direction(view.camera, {64, 48}, pixel);
        EXPECT_GT(glm::dot(glm::normalize(corner->position - view.camera.eye), expected), 0.99999F);
    }
}

/// What a smaller picture shows is to the bit what a picture of that size shows.
TEST(ViewerImage, DrawnSmallerItsSurfacesAreThoseOfASmallPicture) {
    FurnaceView view(0.5F);
    view.image->set_camera(view.camera, {32, 24});
    FurnaceView small(0.5F, {}, 800, {32, 24});
    view.iterate(64);
    small.iterate(64);
    EXPECT_EQ(view.image->read_irradiance(), small.image->read_irradiance());
    EXPECT_EQ(view.image->read_radiance(), small.image->read_radiance());
}

/// A pixel keeps its reflectance in 32 bits, as precisely as there is room for, and in the mean
/// exactly: an unlit floor is white's radiance times it.
TEST(ViewerImage, ReflectanceIsRightInTheMean) {
    constexpr glm::uvec2 size(64, 64);
    constexpr int pixels = 64 * 64;
    for (const bool gridded : {false, true}) {  // with a texture of roughness in the scene
        for (const float reflectance : {0.5F, 0.18F, 0.05F, 0.01F}) {
            SceneBuilder b;
            Material material;
            material.base_colour = glm::vec3(reflectance, 0.7F * reflectance, 0.4F * reflectance);
            material.metallic = 0.0F;
            material.unlit = true;
            b.add_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 2, 2, b.add_material(material));
            const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1.0F));
            b.add_quad({-1, 9, -1}, {2, 0, 0}, {0, 0, 2}, 1, 1, lamp);
            if (gridded) {
                b.scene.textures.push_back({"rough", 1, 1, true, true, {0, 128, 0, 255}});
                Material rough;
                rough.metallic_roughness_texture.texture = 0;
                b.add_quad({-1, 8, -1}, {2, 0, 0}, {0, 0, 2}, 1, 1, b.add_material(rough));
                b.mesh.metallic_roughness.resize(b.mesh.patch_count(), glm::vec2(0.0F, 0.5F));
            }
            const Solver solver(b.scene, b.mesh, {});
            const ViewPrograms programs(solver.scene());
            ViewerImage image(solver.scene(), solver.store(), programs, size);
            Camera camera;
            camera.eye = {0.1F, 1.5F, 0.0F};
            camera.target = {0.0F, 0.0F, 0.1F};
            camera.vertical_fov = 0.8F;
            image.set_camera(camera);
            glm::dvec3 mean(0.0);
            for (const glm::vec4& pixel : image.read_radiance()) {
                mean += glm::dvec3(pixel) / (double{unlit_white} * pixels);
            }
            for (int c = 0; c < 3; ++c) {
                const double exact{material.base_colour[c]};
                // Rounded at random, a root errs by up to a step: half of one in the standard
                // deviation at most. Five of them.
                const double step = gridded ? 1.0 / 255.0 : c < 2 ? 1.0 / 2047.0 : 1.0 / 1023.0;
                const double bound = 5.0 * std::sqrt(exact) * step / 64.0 + step * step;
                EXPECT_NEAR(mean[c], exact, bound) << gridded << " " << reflectance << " " << c;
            }
        }
    }
}

TEST(ViewerImage, TinyAndOddSizesWork) {
    FurnaceView view(0.5F);
    for (const glm::uvec2 size :
         {glm::uvec2(1, 1), glm::uvec2(3, 1), glm::uvec2(1, 257), glm::uvec2(33, 17)}) {
        view.image->set_view(view.camera, size);
        view.iterate(2);
        view.image->compose(DisplayMode::photo, -7.0F);
        EXPECT_EQ(view.image->take().size(), std::size_t{size.x} * size.y * 4);
        view.image->compose(DisplayMode::false_illuminance, -7.0F, {1, 1});
        EXPECT_EQ(view.image->take().size(), 4U);
    }
}

TEST(ViewerImage, ProbeReadsIlluminanceAndPlace) {
    FurnaceView view(0.5F);
    view.iterate(512);
    const auto probe = view.image->probe({32, 24});
    ASSERT_TRUE(probe.has_value());
    const double exact = glm::pi<double>() * static_cast<double>(emission) / 0.5;
    EXPECT_NEAR(static_cast<double>(probe->irradiance.g), exact, 0.1 * exact);
    const glm::vec3 p = probe->position;
    const float distance = std::min({p.x, p.y, p.z, 4.0F - p.x, 3.0F - p.y, 5.0F - p.z});
    EXPECT_NEAR(distance, 0.0F, 1e-3F);  // on a wall
    EXPECT_NEAR(glm::length(probe->normal), 1.0F, 1e-3F);
}

TEST(ViewerImage, DepthsAreThoseOfTheSurfaces) {
    FurnaceView view(0.5F, {}, 800, {120, 90});
    Camera camera;
    camera.eye = {2.0F, 1.5F, 0.5F};
    camera.target = {2.0F, 1.5F, 4.0F};
    camera.vertical_fov = 1.4F;
    view.image->set_camera(camera);
    EXPECT_EQ(view.image->depths(), nullptr);
    view.image->request_depths(31);
    DepthGrid& grid = *view.image->depths();
    ASSERT_EQ(grid.points(), glm::uvec2(31, 24));
    const auto inverse = grid.take();
    ASSERT_EQ(inverse.size(), 31U * 24U);
    // Walls x = 0 and 4, floor 0, ceiling 3, far wall z = 5: the nearest that the ray meets.
    const double reach = std::tan(0.7);
    for (unsigned row = 0; row < 24; ++row) {
        for (unsigned column = 0; column < 31; ++column) {
            const double x = reach * 120.0 / 90.0 * (2.0 * column / 30.0 - 1.0);
            const double y = reach * (1.0 - 2.0 * row / 23.0);
            const double expected = std::max({1.0 / 4.5, std::abs(x) / 2.0, std::abs(y) / 1.5});
            // A point lies somewhere in its pixel: 1.3 / 45 is a pixel's height at distance 1.
            EXPECT_NEAR(static_cast<double>(inverse[row * 31 + column]), expected, 0.02)
                << column << ", " << row;
        }
    }
}

TEST(ViewerImage, GridsOfDepthsHaveSquareCellsAndBoundedSizes) {
    EXPECT_EQ(DepthGrid::points_for(161, {800, 600}), glm::uvec2(161, 121));
    EXPECT_EQ(DepthGrid::points_for(512, {64, 48}), glm::uvec2(64, 48));
    EXPECT_EQ(DepthGrid::points_for(512, {16, 2160}), glm::uvec2(16, 1024));
    EXPECT_EQ(DepthGrid::points_for(2, {1, 1}), glm::uvec2(2, 2));
}

/// What is known of the error belongs to a scene: after a change nothing is, until samples have
/// come.
TEST(ViewerImage, AfterAChangeTheErrorIsUnknownUntilThereAreSamples) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 6, wall);
    b.add_quad({1.5F, 2.9F, 2}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    SolverSettings settings;
    settings.coarse = {128, 400};
    Solver solver(b.scene, b.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {64, 48});
    Camera camera;
    camera.eye = {0.5F, 1.5F, 0.5F};
    camera.target = {3.0F, 0.5F, 4.0F};
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    const auto known_after = [&](int iterations) {
        for (int i = 0; i < iterations; ++i) {
            solver.step(receivers);
        }
        image.request_statistics();
        image.finish_statistics();
        return image.statistics().known;
    };
    EXPECT_TRUE(known_after(64));
    b.scene.materials[lamp].emission *= glm::vec3(0.2F, 0.5F, 0.9F);
    const std::vector<std::uint32_t> materials = {lamp};
    solver.change_surfaces(b.scene, b.mesh, materials, {}, receivers);
    EXPECT_FALSE(image.statistics().known);
    while (solver.correcting()) {
        solver.step(receivers);
    }
    EXPECT_FALSE(known_after(0));
    EXPECT_FALSE(known_after(4));
    EXPECT_TRUE(known_after(2 * GROUP_SIZE));
    // A camera that moves shows the same scene.
    camera.target.x = 2.8F;
    image.set_camera(camera);
    EXPECT_TRUE(known_after(0));
}

}  // namespace
}  // namespace raybundle::viewer_test
