// SPDX-License-Identifier: Apache-2.0
// Large pictures made of tiles, and sizes within limits.
#include "view/tiles/picture_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "oracle/scene_builder.h"
#include "transport/solver.h"
#include "view/picture_limits.h"

namespace raybundle::picture_tiles_test {
namespace {

/// A room with a box and a lamp: edges and shades that cross the seams.
struct Room {
    Room() {
        const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
        const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(100.0F));
        b.add_box({0, 0, 0}, {4, 3, 5}, true, 3, wall);
        b.add_box({1, 0, 2}, {2, 1, 3}, false, 2, wall);
        b.add_quad({1.5F, 2.95F, 2}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
        SolverSettings settings;
        settings.coarse = {64, 100};
        settings.coarse_iterations = 1'000'000;
        solver.emplace(b.scene, b.mesh, settings);
        programs.emplace(solver->scene());
        camera.eye = {0.5F, 1.5F, 0.5F};
        camera.target = {3.0F, 1.0F, 4.0F};
        camera.vertical_fov = 1.2F;
    }

    SceneBuilder b;
    std::optional<Solver> solver;
    std::optional<ViewPrograms> programs;
    Camera camera;
};

TEST(CasesPictureTiles, ShowWhatTheWholePictureShows) {
    constexpr glm::uvec2 size(90, 70);
    Room room;
    for (int i = 0; i < 64; ++i) {
        room.solver->step({});
    }
    const auto make = [&](const Camera& camera, glm::uvec2 pixels) {
        auto image = std::make_unique<ViewerImage>(room.solver->scene(), room.solver->store(),
                                                   *room.programs, pixels);
        image->set_camera(camera);
        image->smooth();
        return image;
    };
    const std::vector<glm::vec4> exact = make(room.camera, size)->read_radiance();
    PictureTiles tiles(size, PictureTiles::Content::radiance, 32, 1000);
    EXPECT_EQ(tiles.count(), 9U);
    std::size_t most = 0;
    while (!tiles.complete()) {
        const auto image = make(tiles.drawn_camera(room.camera), tiles.drawn_size());
        most = std::max(most, std::size_t{image->size().x} * image->size().y);
        tiles.take(*image, {});
    }
    EXPECT_LE(most, 48U * 48U);
    const std::vector<glm::vec4> made = tiles.take_radiance();
    ASSERT_EQ(made.size(), exact.size());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < made.size(); ++i) {
        differ += std::abs(made[i].g - exact[i].g) > 5e-3F * exact[i].g ? 1 : 0;
    }
    // Light at vertices is in half floats; rays through centres that hit an edge may go to either
    // side of it.
    EXPECT_LT(differ, made.size() / 200);
}

TEST(CasesPictureTiles, CoverTheLargestPictureInTilesOfBoundedSize) {
    PictureTiles tiles(glm::uvec2(8192), PictureTiles::Content::display);
    EXPECT_EQ(tiles.count(), 16U);
    EXPECT_LE(std::size_t{tiles.drawn_size().x} * tiles.drawn_size().y, PictureTiles::most_pixels);
    EXPECT_EQ(PictureTiles({3840, 2160}, PictureTiles::Content::display).count(), 1U);
    const Camera first = tiles.drawn_camera({});
    EXPECT_NEAR(first.part.x, -1.0F + 2056.0F / 8192.0F, 1e-6F);
    EXPECT_NEAR(first.part.y, 1.0F - 2056.0F / 8192.0F, 1e-6F);
}

/// As large as the limits allow, one iteration a tile; the tiles' sizes are those of 8192 x 8192.
TEST(HeavyPictureTiles, PictureOf8192Squared) {
    Room room;
    for (int i = 0; i < 64; ++i) {
        room.solver->step({});
    }
    PictureTiles tiles(glm::uvec2(8192), PictureTiles::Content::display);
    while (!tiles.complete()) {
        ViewerImage image(room.solver->scene(), room.solver->store(), *room.programs,
                          tiles.drawn_size());
        image.set_camera(tiles.drawn_camera(room.camera));
        BundleReceiver* const receivers[] = {&image};
        room.solver->step(receivers);
        tiles.take(image, {});
    }
    const std::vector<std::uint8_t> bytes = tiles.take_display();
    ASSERT_EQ(bytes.size(), std::size_t{4} * 8192 * 8192);
    for (std::size_t i = 1; i < bytes.size(); i += 4UL * 997) {
        ASSERT_GT(bytes[i], 0) << i / 4 % 8192 << ", " << i / 4 / 8192;
    }
}

TEST(CasesPictureTiles, ViewportsAreFittedIntoTheLimits) {
    const PictureLimits limits{8192, 3840UL * 2160UL};
    EXPECT_EQ(fitted({1290, 2796}, limits), glm::uvec2(1290, 2796));
    EXPECT_EQ(fitted({5120, 2880}, limits), glm::uvec2(3840, 2160));
    EXPECT_EQ(fitted({7680, 4320}, limits), glm::uvec2(3840, 2160));
    EXPECT_EQ(fitted({65535, 1}, limits), glm::uvec2(8192, 1));
    EXPECT_EQ(fitted({0, 0}, limits), glm::uvec2(1, 1));
    const PictureLimits actual = picture_limits();
    EXPECT_EQ(actual.edge, 8192U);
    EXPECT_EQ(actual.pixels, 3840UL * 2160UL);
}

}  // namespace
}  // namespace raybundle::picture_tiles_test
