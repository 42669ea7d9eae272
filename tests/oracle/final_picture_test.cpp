// SPDX-License-Identifier: Apache-2.0
// Pictures that are made to be kept: finer pixels where light changes within them.
#include "view/final_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "oracle/scene_builder.h"
#include "transport/solver.h"

namespace raybundle::final_picture_test {
namespace {

constexpr glm::uvec2 size(24, 18);

/// A wall behind a row of boards, lit from the side: light changes within each pixel of the
/// picture.
SceneBuilder boards() {
    SceneBuilder b;
    const auto paint = b.add_material(glm::vec3(0.6F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(500.0F));
    b.add_box({-1, -1, 0}, {1, 1, 2}, true, 4, paint);
    b.add_quad({-0.99F, -0.8F, 0.2F}, {0, 1.6F, 0}, {0, 0, 1.6F}, 1, 1, lamp);
    for (int i = 0; i < 14; ++i) {
        const float x = -0.83F + 0.12F * static_cast<float>(i);
        b.add_box({x, -0.9F, 0.02F}, {x + 0.05F, 0.9F, 0.1F}, false, 1, paint);
    }
    return b;
}

Camera in_front() {
    Camera camera;
    camera.eye = {0.1F, 0.05F, 1.9F};
    camera.target = {0.0F, 0.0F, 0.0F};
    camera.vertical_fov = 0.75F;
    return camera;
}

SolverSettings coarse_settings() {
    SolverSettings settings;
    settings.coarse = {64, 100};
    settings.coarse_iterations = 1'000'000;
    return settings;
}

std::vector<glm::vec4> averaged(const std::vector<glm::vec4>& fine, unsigned grid) {
    std::vector<glm::vec4> result(std::size_t{size.x} * size.y, glm::vec4(0.0F));
    for (std::size_t i = 0; i < fine.size(); ++i) {
        const std::size_t width = std::size_t{size.x} * grid;
        result[i / width / grid * size.x + i % width / grid] +=
            fine[i] / static_cast<float>(grid * grid);
    }
    return result;
}

double difference(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
    double sum = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::vec3 d(a[i] - b[i]);
        sum += static_cast<double>(glm::dot(d, d));
        all += static_cast<double>(glm::dot(glm::vec3(b[i]), glm::vec3(b[i])));
    }
    return std::sqrt(sum / all);
}

TEST(FinalPicture, IsTheMeanOverItsPixelsAreas) {
    const SceneBuilder b = boards();
    Solver solver(b.scene, b.mesh, coarse_settings());
    const ViewPrograms programs(solver.scene());
    FinalPicture adaptive(solver.scene(), solver.store(), programs, in_front(), size);
    FinalPicture centres(solver.scene(), solver.store(), programs, in_front(), size,
                         PixelGrid::centres);
    FinalPicture fine(solver.scene(), solver.store(), programs, in_front(), size * 8U,
                      PixelGrid::centres);
    // The same bundles for all, so that their noise is the same.
    BundleReceiver* const receivers[] = {&adaptive.receiver(), &centres.receiver(),
                                         &fine.receiver()};
    while (solver.iterations() < 1024) {
        for (FinalPicture* const picture : {&adaptive, &centres, &fine}) {
            picture->prepare();
        }
        solver.step(receivers);
    }
    EXPECT_EQ(adaptive.pixel_grid(), 8U);
    EXPECT_EQ(centres.pixel_grid(), 1U);
    EXPECT_EQ(adaptive.size(), size);
    const auto truth = averaged(fine.read_radiance(), 8);
    ASSERT_EQ(adaptive.read_radiance().size(), truth.size());
    const double by_centres = difference(centres.read_radiance(), truth);
    const double by_areas = difference(adaptive.read_radiance(), truth);
    EXPECT_GT(by_centres, 0.04);
    EXPECT_LT(by_areas, 0.15 * by_centres);
    EXPECT_LT(adaptive.measure().discretisation, centres.measure().discretisation);
    EXPECT_EQ(adaptive.read_display().size(), truth.size() * 4);
}

/// A wall behind a dark board that is lit from behind: a line of light round it, parallel to the
/// picture's rows and columns and narrower than a quarter of a pixel.
SceneBuilder backlit_board() {
    SceneBuilder b;
    const auto paint = b.add_material(glm::vec3(0.4F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(500.0F));
    b.add_box({-1, -1, 0}, {1, 1, 2}, true, 8, paint);
    b.add_quad({-0.53F, -0.32F, 0.01F}, {0, 0.6F, 0}, {1, 0, 0}, 4, 4, lamp);
    return b;
}

TEST(HeavyFinalPicture, PartsOfPixelsSeeALineAlongTheRowsThatIsNarrowerThanThey) {
    const SceneBuilder b = backlit_board();
    Solver solver(b.scene, b.mesh, coarse_settings());
    const ViewPrograms programs(solver.scene());
    Camera camera = in_front();
    camera.eye = {0.0F, 0.0F, 1.9F};
    ViewerImage staggered(solver.scene(), solver.store(), programs, size);
    staggered.set_camera(camera);
    staggered.rest();
    staggered.refine(4);
    FinalPicture even(solver.scene(), solver.store(), programs, camera, size * 4U,
                      PixelGrid::centres);
    FinalPicture fine(solver.scene(), solver.store(), programs, camera, size * 32U,
                      PixelGrid::centres);
    BundleReceiver* const receivers[] = {&staggered, &even.receiver(), &fine.receiver()};
    while (solver.iterations() < 512) {
        staggered.smooth();
        even.prepare();
        fine.prepare();
        solver.step(receivers);
    }
    const auto truth = averaged(fine.read_radiance(), 32);
    const double evenly = difference(averaged(even.read_radiance(), 4), truth);
    EXPECT_GT(evenly, 0.3);
    EXPECT_LT(difference(averaged(staggered.read_radiance(), 4), truth), 0.5 * evenly);
}

TEST(FinalPicture, PartsOfPixelsKeepSamplesOfAFloorThatIsSeenAtASlant) {
    SceneBuilder b;
    const auto paint = b.add_material(glm::vec3(0.5F), glm::vec3(1.0F));
    b.add_box({-1, -1, -1}, {1, 1, 1}, true, 8, paint);
    Solver solver(b.scene, b.mesh, coarse_settings());
    const ViewPrograms programs(solver.scene());
    Camera camera;
    camera.eye = {0.0F, -0.95F, 0.9F};
    camera.target = {0.0F, -1.0F, 0.2F};
    camera.vertical_fov = 0.1F;
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    while (solver.iterations() < 64) {
        solver.step(receivers);
    }
    image.refine(4);
    int with_samples = 0;
    for (const glm::vec4& pixel : image.read_irradiance()) {
        with_samples += pixel.w > 0.0F ? 1 : 0;
    }
    // Parts of those in the picture's margin may show what was beside it, by rounding.
    EXPECT_GT(with_samples, 0.95 * 16 * size.x * size.y);
}

TEST(FinalPicture, ComesOutTheSameEveryTime) {
    const SceneBuilder b = boards();
    const auto render = [&] {
        Solver solver(b.scene, b.mesh, coarse_settings());
        const ViewPrograms programs(solver.scene());
        FinalPicture picture(solver.scene(), solver.store(), programs, in_front(), size);
        BundleReceiver* const receivers[] = {&picture.receiver()};
        while (solver.iterations() < 300) {
            picture.prepare();
            solver.step(receivers);
        }
        EXPECT_GT(picture.pixel_grid(), 1U);
        return picture.read_radiance();
    };
    EXPECT_EQ(render(), render());
}

TEST(FinalPicture, AnEvenWallNeedsNoFinerPixels) {
    SceneBuilder b;
    const auto paint = b.add_material(glm::vec3(0.5F), glm::vec3(1.0F));
    b.add_box({-1, -1, -1}, {1, 1, 1}, true, 8, paint);
    Solver solver(b.scene, b.mesh, coarse_settings());
    const ViewPrograms programs(solver.scene());
    Camera camera;
    camera.eye = {0.0F, 0.0F, 0.5F};
    camera.target = {0.0F, 0.0F, -1.0F};
    FinalPicture picture(solver.scene(), solver.store(), programs, camera, size);
    BundleReceiver* const receivers[] = {&picture.receiver()};
    while (solver.iterations() < 200) {
        picture.prepare();
        solver.step(receivers);
    }
    EXPECT_EQ(picture.pixel_grid(), 1U);
}

}  // namespace
}  // namespace raybundle::final_picture_test
