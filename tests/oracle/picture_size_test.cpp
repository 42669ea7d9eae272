// SPDX-License-Identifier: Apache-2.0
// Pictures of all sizes, and what the driver does not take.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/egl_context.h"
#include "gpu/gl_limits.h"
#include "oracle/scene_builder.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::picture_size_test {
namespace {

constexpr float emission = 100.0F;
constexpr float albedo = 0.5F;

/// A closed room of 12 patches that emits everywhere: Le / (1 - albedo) wherever one looks.
struct Furnace {
    Furnace() {
        const auto m = builder.add_material(glm::vec3(albedo), glm::vec3(emission));
        builder.add_box({0, 0, 0}, {4, 3, 5}, true, 1, m);
        SolverSettings settings;
        settings.coarse = {64, 100};
        settings.coarse_iterations = 1'000'000;
        solver.emplace(builder.scene, builder.mesh, settings);
        programs.emplace(solver->scene());
        camera.eye = {0.5F, 1.5F, 0.5F};
        camera.target = {3.0F, 1.2F, 4.0F};
        camera.vertical_fov = 1.2F;
    }

    SceneBuilder builder;
    std::optional<Solver> solver;
    std::optional<ViewPrograms> programs;
    Camera camera;
};

class PictureSize : public testing::TestWithParam<glm::uvec2> {};

TEST_P(PictureSize, HasLightInEveryPartOfThePicture) {
    const glm::uvec2 size = GetParam();
    Furnace furnace;
    for (int i = 0; i < 64; ++i) {
        furnace.solver->step({});
    }
    ViewerImage image(furnace.solver->scene(), furnace.solver->store(), *furnace.programs, size);
    image.set_camera(furnace.camera);
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 8; ++i) {
        furnace.solver->step(receivers);
    }
    const std::vector<glm::vec4> picture = image.read_radiance();
    ASSERT_EQ(picture.size(), std::size_t{size.x} * size.y);
    // The solution is right to some per cent by then; bands tell which part is missing.
    const std::size_t bands = size.x < 16 ? 1 : std::min<std::size_t>(size.y, 16);
    for (std::size_t band = 0; band < bands; ++band) {
        const std::size_t first = band * size.y / bands * size.x;
        const std::size_t last = (band + 1) * size.y / bands * size.x;
        double sum = 0.0;
        float least = emission / (1.0F - albedo);
        for (std::size_t i = first; i < last; ++i) {
            sum += static_cast<double>(picture[i].g);
            least = std::min(least, picture[i].g);
        }
        const double exact = static_cast<double>(emission / (1.0F - albedo));
        EXPECT_NEAR(sum / static_cast<double>(last - first), exact, 0.1 * exact) << band;
        EXPECT_GT(least, emission) << band;
    }
    image.compose(DisplayMode::photo, 0.0F);
    const std::span<const std::uint8_t> shown = image.take();
    ASSERT_EQ(shown.size(), 4 * picture.size());
    for (std::size_t i = 1; i < shown.size(); i += 4) {
        ASSERT_GT(shown[i], 0) << i / 4 % size.x << ", " << i / 4 / size.x;
    }
}

std::string size_name(const testing::TestParamInfo<glm::uvec2>& info) {
    return std::to_string(info.param.x) + "x" + std::to_string(info.param.y);
}

/// 4 194 240 pixels are 65 535 groups of 64, as many as a row of groups may have.
INSTANTIATE_TEST_SUITE_P(Cases, PictureSize,
                         testing::Values(glm::uvec2(1, 1), glm::uvec2(1, 2160),
                                         glm::uvec2(3840, 40), glm::uvec2(2048, 2048),
                                         glm::uvec2(3840, 2160)),
                         size_name);

TEST(CasesDriverLimits, GroupsAreFoldedIntoAsFewEvenRowsAsThereCanBe) {
    const glm::uvec2 most(65535, 65535);
    EXPECT_EQ(folded(1, most, ""), glm::uvec2(1, 1));
    EXPECT_EQ(folded(65535, most, ""), glm::uvec2(65535, 1));
    EXPECT_EQ(folded(65536, most, ""), glm::uvec2(32768, 2));
    const glm::uvec2 rows = folded(1'000'003, most, "");
    EXPECT_EQ(rows.y, 16U);
    EXPECT_GE(std::size_t{rows.x} * rows.y, 1'000'003U);
    EXPECT_LT(std::size_t{rows.x} * rows.y, 1'000'003U + rows.y);
}

/// The text that names what does not fit; empty where all does.
template <typename Check>
std::string refusal_by(Check check) {
    try {
        check();
    } catch (const GpuError& error) {
        return error.what();
    }
    return {};
}

TEST(CasesDriverLimits, WhatDoesNotFitIsNamedWithTheLimit) {
    EXPECT_NE(refusal_by([] {
                  folded(50, {4, 5}, "view.comp");
              }).find("view.comp needs 4x13"),
              std::string::npos);
    const std::size_t bytes = most_storage_bytes();
    EXPECT_TRUE(refusal_by([&] { check_storage("pixels", bytes); }).empty());
    EXPECT_NE(refusal_by([&] { check_storage("pixels", bytes + 1); }).find("pixels need"),
              std::string::npos);
    EXPECT_NE(refusal_by([] { check_texture_2d("view", 1 << 20, 1); }).find("1048576x1"),
              std::string::npos);
    EXPECT_NE(refusal_by([] { Buffer("patches", std::size_t{1} << 40U); }).find("1048576 MiB"),
              std::string::npos);
    EXPECT_NE(refusal_by([] { check_texture_layers("maps", 1U << 30U); }).find("1073741824"),
              std::string::npos);
    EXPECT_NE(
        refusal_by([] { check_buffer_texture("pixels", std::size_t{1} << 40U, 1); }).find("texels"),
        std::string::npos);
}

/// Whatever the driver has refused, no picture is made of what was to come of it.
TEST(CasesDriverLimits, RefusedCommandFailsThePicture) {
    Furnace furnace;
    ViewerImage image(furnace.solver->scene(), furnace.solver->store(), *furnace.programs,
                      {16, 16});
    image.set_camera(furnace.camera);
    glDispatchCompute(most_work_groups().x + 1, 1, 1);
    EXPECT_THROW(image.compose(DisplayMode::photo, 0.0F), GlError);
    EXPECT_NO_THROW(image.compose(DisplayMode::photo, 0.0F));
    glDispatchCompute(most_work_groups().x + 1, 1, 1);
    EXPECT_THROW(image.read_radiance(), GlError);
    EXPECT_NO_THROW(image.read_radiance());
}

}  // namespace
}  // namespace raybundle::picture_size_test
