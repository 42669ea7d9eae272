// SPDX-License-Identifier: Apache-2.0
// Rooms that are closed, below a bright sky: nothing comes in, whatever their walls are made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "oracle/scene_builder.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::closed_room_test {
namespace {

constexpr float sky = 1000.0F;  // cd/m²
constexpr glm::vec3 extent(4, 3, 5);

/// Walls without thickness whose triangles end elsewhere than those of their neighbours. cells: of
/// the walls, along their first and second edges.
SceneBuilder room(const std::vector<glm::uvec2>& cells) {
    SceneBuilder b;
    b.scene.sky_radiance = glm::vec3(sky);
    const auto m = b.add_material(glm::vec3(0.7F));
    const glm::vec3 x(extent.x, 0, 0);
    const glm::vec3 y(0, extent.y, 0);
    const glm::vec3 z(0, 0, extent.z);
    const glm::vec3 o(0.0F);
    b.add_quad(o, z, x, cells[0].x, cells[0].y, m);  // floor, up
    b.add_quad(y, x, z, cells[1].x, cells[1].y, m);  // ceiling, down
    b.add_quad(o, x, y, cells[2].x, cells[2].y, m);  // +z
    b.add_quad(z, y, x, cells[3].x, cells[3].y, m);  // -z
    b.add_quad(o, y, z, cells[4].x, cells[4].y, m);  // +x
    b.add_quad(x, z, y, cells[5].x, cells[5].y, m);  // -x
    return b;
}

/// Largest and mean radiance of a picture from inside, and mean irradiance of the patches over pi,
/// as shares of the sky's.
struct Leak {
    double largest = 0.0;
    double picture = 0.0;
    double patches = 0.0;
    float exposure = 0.0F;              ///< that a picture gets by itself, stops
    std::optional<double> darker_than;  ///< as the picture says, share of the sky's
};

Leak leak_of(const SceneBuilder& b) {
    SolverSettings settings;
    settings.coarse = {64, 96};
    settings.coarse_iterations = 1'000'000;
    Solver solver(b.scene, b.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {48, 36});
    Camera camera;
    camera.eye = {0.4F, 1.6F, 0.4F};
    camera.target = {3, 0.8F, 4};
    camera.vertical_fov = 1.3F;
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 128; ++i) {
        solver.step(receivers);
    }
    image.request_statistics();
    image.finish_statistics();
    Leak leak;
    leak.exposure = image.automatic_exposure();
    if (const auto darker_than = image.statistics().darker_than()) {
        leak.darker_than = *darker_than / static_cast<double>(sky);
    }
    const auto picture = image.read_radiance();
    for (const glm::vec4& pixel : picture) {
        leak.largest = std::max(leak.largest, static_cast<double>(pixel.g / sky));
        leak.picture += static_cast<double>(pixel.g / sky) / static_cast<double>(picture.size());
    }
    const auto irradiance = solver.store().read_irradiance();
    for (const glm::vec4& e : irradiance) {
        leak.patches +=
            static_cast<double>(e.g / sky) / (3.14159 * static_cast<double>(irradiance.size()));
    }
    return leak;
}

class ClosedRoom : public testing::TestWithParam<std::vector<glm::uvec2>> {};

TEST_P(ClosedRoom, BelowASkyIsDark) {
    const Leak leak = leak_of(room(GetParam()));
    EXPECT_LT(leak.picture, 1e-5);
    EXPECT_LT(leak.largest, 1e-3);
    // What comes in by rounding is no light, and not lifted to mid-grey: that is a thousandth of
    // the sky.
    ASSERT_TRUE(leak.darker_than);
    EXPECT_NEAR(*leak.darker_than, 1e-4, 1e-6);
    EXPECT_NEAR(leak.exposure, -std::log2(1e-3F * sky), 0.01F);
    EXPECT_LT(leak.patches, 1e-5);
}

/// Whole walls, and slivers.
INSTANTIATE_TEST_SUITE_P(
    Walls, ClosedRoom,
    testing::Values(std::vector<glm::uvec2>(6, {4, 4}),
                    std::vector<glm::uvec2>{
                        {401, 1}, {1, 397}, {389, 1}, {1, 383}, {379, 1}, {1, 373}}));

/// Cells of 80 mm, which windows see by two pixels, and whose corners meet no others along the
/// edges of the room. What the rasteriser leaves open there is found but for a tenth: 1.3e-4 of the
/// sky came in.
TEST(ClosedRoomOfManyCells, BelowASkyIsNearlyDark) {
    const Leak leak = leak_of(room({{47, 41}, {39, 43}, {37, 31}, {29, 41}, {33, 53}, {45, 35}}));
    EXPECT_LT(leak.picture, 3e-5);
    EXPECT_LT(leak.patches, 2e-5);
    EXPECT_TRUE(leak.darker_than);
}

}  // namespace
}  // namespace raybundle::closed_room_test
