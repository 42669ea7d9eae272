// SPDX-License-Identifier: Apache-2.0
// Antialiasing of pictures at rest: the share of an edge pixel that a surface covers is known in
// closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "oracle/scene_builder.h"
#include "transport/solver.h"
#include "view/filters/sub_samples.h"
#include "view/viewer_image.h"

namespace raybundle::edge_filter_test {
namespace {

constexpr glm::uvec2 size(48, 40);
constexpr float lamp_radiance = 1e5F;

/// The area left of a straight line through a pixel errs by 0.10 at most with these sub-samples
/// (edge_filter.cpp); the rest is the rasteriser's fixed-point coordinates and the test's own sum.
constexpr double coverage_error = 0.12;

/// A wide lamp that ends at x = 0, before a black wall, seen upright on by a camera that is turned.
struct EdgeView {
    EdgeView() {
        const auto lamp = builder.add_material(glm::vec3(0.0F), glm::vec3(lamp_radiance));
        const auto wall = builder.add_material(glm::vec3(0.0F));
        builder.add_quad({-20, -20, 0}, {20, 0, 0}, {0, 40, 0}, 4, 4, lamp);
        builder.add_quad({-40, -40, -1}, {80, 0, 0}, {0, 80, 0}, 4, 4, wall);
        solver.emplace(builder.scene, builder.mesh, SolverSettings{});
        programs.emplace(solver->scene());
        image.emplace(solver->scene(), solver->store(), *programs, size);
    }

    void turn(float angle) {
        camera.eye = {0.013F, 0, 5};
        camera.target = {0.013F, 0, 0};
        camera.up = {std::sin(angle), std::cos(angle), 0};
        camera.vertical_fov = 0.6F;
        edge_angle = angle;
        image->set_camera(camera);
    }

    /// Share of a pixel (row 0 at the top) that the lamp covers.
    [[nodiscard]] double coverage(unsigned x, unsigned y) const {
        constexpr int cells = 32;
        const double metres = 2.0 * 5.0 * std::tan(0.3) / size.y;  // a pixel on the lamp
        int covered = 0;
        for (int i = 0; i < cells * cells; ++i) {
            const double right = (x + (i % cells + 0.5) / cells - 0.5 * size.x) * metres;
            const double up = (0.5 * size.y - y - (i / cells + 0.5) / cells) * metres;
            const double angle = static_cast<double>(edge_angle);
            const double at_x = 0.013 + right * std::cos(angle) + up * std::sin(angle);
            covered += at_x < 0.0 ? 1 : 0;
        }
        return covered / static_cast<double>(cells * cells);
    }

    SceneBuilder builder;
    std::optional<Solver> solver;
    std::optional<ViewPrograms> programs;
    std::optional<ViewerImage> image;
    Camera camera;
    float edge_angle = 0.0F;
};

struct CoverageErrors {
    double largest = 0.0;
    double mean = 0.0;  // signed, of the edge pixels
};

/// value(index): what the picture makes of the coverage of a pixel, 0..1.
template <typename Value>
CoverageErrors coverage_errors(const EdgeView& view, const Value& value) {
    CoverageErrors errors;
    int count = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const double exact = view.coverage(x, y);
            const double error = value(std::size_t{y} * size.x + x) - exact;
            errors.largest = std::max(errors.largest, std::abs(error));
            if (exact > 0.0 && exact < 1.0) {
                errors.mean += error;
                ++count;
            }
        }
    }
    errors.mean /= std::max(count, 1);
    return errors;
}

class SlantedEdge : public testing::TestWithParam<float> {};

TEST_P(SlantedEdge, RadianceIsThatOfTheCoveredArea) {
    EdgeView view;
    view.turn(GetParam());
    const auto errors = [&] {
        const auto picture = view.image->read_radiance();
        return coverage_errors(
            view, [&](std::size_t i) { return static_cast<double>(picture[i].g / lamp_radiance); });
    };
    EXPECT_GT(errors().largest, 0.35);  // at the centres alone
    view.image->smooth();
    EXPECT_TRUE(view.image->smoothed());
    EXPECT_LT(errors().largest, coverage_error);
    EXPECT_LT(std::abs(errors().mean), 0.03);
}

/// A lamp that is a thousand times brighter than white has edges as smooth as white paper.
TEST_P(SlantedEdge, DisplayedLightIsThatOfTheCoveredArea) {
    EdgeView view;
    view.turn(GetParam());
    view.image->smooth();
    view.image->compose(DisplayMode::photo, std::log2(1e3F / (0.18F * lamp_radiance)));
    const auto frame = view.image->take();
    const CoverageErrors errors = coverage_errors(view, [&](std::size_t i) {
        const double encoded = frame[4 * i + 1] / 255.0;
        return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    });
    EXPECT_LT(errors.largest, coverage_error + 0.005);
    EXPECT_LT(std::abs(errors.mean), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Angles, SlantedEdge, testing::Values(0.03F, 0.2F, 0.6F, 1.1F, 1.5F, 2.4F));

/// A glowing bar a third of a pixel wide before a black wall, slanted: in most rows no centre of a
/// pixel shows it.
TEST(EdgeFilter, WhatIsThinnerThanAPixelIsSeen) {
    SceneBuilder b;
    const float pixel = 2.0F * 5.0F * std::tan(0.3F) / static_cast<float>(size.y);  // m, of the bar
    const float width = 0.33F * pixel;
    const auto glow = b.add_material(glm::vec3(0.0F), glm::vec3(lamp_radiance));
    b.add_quad({0, -20, 0}, {width, 0, 0}, {6, 40, 0}, 1, 8, glow);
    b.add_quad({-40, -40, -1}, {80, 0, 0}, {0, 80, 0}, 4, 4, b.add_material(glm::vec3(0.0F)));
    const Solver solver(b.scene, b.mesh, SolverSettings{});
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    Camera camera;
    camera.eye = {3.0F, 0, 5};
    camera.target = {3.0F, 0, 0};
    camera.vertical_fov = 0.6F;
    image.set_camera(camera);
    // Light of each row: the bar's width in pixels times its radiance.
    const auto light_of_rows = [&] {
        const auto picture = image.read_radiance();
        std::vector<double> rows(size.y, 0.0);
        for (std::size_t i = 0; i < picture.size(); ++i) {
            rows[i / size.x] +=
                static_cast<double>(picture[i].g) / static_cast<double>(lamp_radiance);
        }
        return rows;
    };
    // All or nothing.
    for (const double row : light_of_rows()) {
        EXPECT_NEAR(row, std::round(row), 1e-3);
    }
    image.smooth();
    // What the 16 sub-samples of a row's pixels meet of the bar, but for one that its edge may run
    // through.
    const auto met_in_row = [&](unsigned y) {
        int met = 0;
        for (unsigned x = 0; x < size.x; ++x) {
            for (unsigned k = 0; k < EDGE_SAMPLES; ++k) {
                const glm::vec2 at =
                    (glm::vec2(x, y) + 0.5F + sub_sample(k) - 0.5F * glm::vec2(size)) * pixel;
                const float from_bar = camera.eye.x + at.x - (at.y + 20.0F) * 6.0F / 40.0F;
                met += from_bar >= 0.0F && from_bar <= width ? 1 : 0;
            }
        }
        return met / static_cast<double>(EDGE_SAMPLES);
    };
    const std::vector<double> rows = light_of_rows();
    for (unsigned y = 0; y < size.y; ++y) {
        // Pictures begin with their topmost row.
        EXPECT_NEAR(rows[y], met_in_row(size.y - 1 - y), 1.01 / EDGE_SAMPLES) << "row " << y;
        // Each edge of the bar may win or lose one of the 16 places.
        EXPECT_NEAR(rows[y], 0.33, 2.0 / EDGE_SAMPLES) << "row " << y;
    }
}

/// Where all light is alike, thin bars are no darker or brighter than what is behind them: the
/// solution in object space that they are drawn with has the scale of the pixels' own.
TEST(EdgeFilter, ThinBarsHaveTheLightOfTheSolution) {
    SceneBuilder b;
    const auto m = b.add_material(glm::vec3(0.5F), glm::vec3(100.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 6, m);
    for (int i = 0; i < 20; ++i) {
        const float x = 1.0F + 0.1F * static_cast<float>(i);
        b.add_box({x, 0.5F, 2.5F}, {x + 0.004F, 2.5F, 2.504F}, false, 1, m);
    }
    SolverSettings settings;
    settings.coarse = {128, 400};
    Solver solver(b.scene, b.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {96, 72});
    Camera camera;
    camera.eye = {2.0F, 1.5F, 0.3F};
    camera.target = {2.1F, 1.4F, 4.0F};
    camera.vertical_fov = 1.0F;
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 512; ++i) {
        solver.step(receivers);
    }
    image.smooth();
    for (const glm::vec4& pixel : image.read_radiance()) {
        ASSERT_NEAR(pixel.g, 200.0F, 24.0F);  // Le / (1 - albedo)
    }
}

TEST(EdgeFilter, EndsWhenTheCameraMoves) {
    EdgeView view;
    view.turn(0.2F);
    EXPECT_FALSE(view.image->smoothed());
    unsigned steps = 0;
    while (view.image->smooth_step()) {
        ++steps;
        EXPECT_FALSE(view.image->smoothed());
    }
    EXPECT_EQ(steps + 1, EdgeFilter::samples);
    const auto before = view.image->read_radiance();
    view.turn(0.2F);
    EXPECT_FALSE(view.image->smoothed());
    view.image->smooth();
    EXPECT_EQ(view.image->read_radiance(), before);  // the same bits
    view.image->set_view(view.camera, {33, 17});
    EXPECT_FALSE(view.image->smoothed());
    EXPECT_FALSE(view.image->read_radiance().empty());
}

/// Pieces of one flat surface have no edges between them, in whatever order they are drawn.
TEST(EdgeFilter, LeavesFlatSurfacesAsTheyAre) {
    SceneBuilder builder;
    const auto wall = builder.add_material(glm::vec3(0.6F));
    const auto lamp = builder.add_material(glm::vec3(0.0F), glm::vec3(100.0F));
    builder.add_quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 5, 5, wall);
    builder.add_quad({-9, -9, 20}, {0, 18, 0}, {18, 0, 0}, 1, 1, lamp);
    Solver solver(builder.scene, builder.mesh, SolverSettings{});
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    Camera camera;
    camera.eye = {1, 2, 5};
    camera.target = {0.3F, 0, 0};
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 8; ++i) {
        solver.step(receivers);
    }
    const auto centres = image.read_radiance();
    EXPECT_NE(centres.front(), centres.back());
    image.smooth();
    EXPECT_EQ(image.read_radiance(), centres);
}

}  // namespace
}  // namespace raybundle::edge_filter_test
