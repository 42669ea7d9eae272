// SPDX-License-Identifier: Apache-2.0
// Light of scenes far from zero, beside strays, and while objects are far away.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "moved_box.h"
#include "scene/gltf/gltf_loader.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::far_coordinates_test {
namespace {

/// Radiance at the pixels of the file's first camera, cd/m².
std::vector<glm::vec4> picture_of(const std::string& file, int iterations) {
    Scene scene = load_gltf(std::string(RAYBUNDLE_CASES) + "/far/" + file);
    TessellationSettings tessellation;
    tessellation.target_patches = 3000;
    const PatchMesh mesh = tessellate(scene, tessellation);
    Solver solver(scene, mesh);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {24, 24});
    image.set_camera(scene.cameras.front());
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < iterations; ++i) {
        solver.step(receivers);
    }
    return image.read_radiance();
}

double mean(const std::vector<glm::vec4>& picture) {
    double sum = 0.0;
    for (const glm::vec4& pixel : picture) {
        sum += static_cast<double>(pixel.g);
    }
    return sum / static_cast<double>(picture.size());
}

TEST(CasesFarLight, AnOffsetOfANodeCostsNoLight) {
    const double near = mean(picture_of("origin.gltf", 160));
    EXPECT_NEAR(near, 3.34, 0.02 * 3.34);
    EXPECT_NEAR(mean(picture_of("utm_node.gltf", 160)), near, 0.01 * near);
}

/// Without the stray it is the same scene: the same bits, in as many iterations.
TEST(CasesFarLight, AStrayTriangleCostsNoLight) {
    const std::vector<glm::vec4> clean = picture_of("clean.gltf", 24);
    EXPECT_EQ(picture_of("stray_2km.gltf", 24), clean);
    EXPECT_EQ(picture_of("stray_60km.gltf", 24), clean);
}

/// What a room's walls get after its box has been somewhere for 128 iterations, and after it has
/// come back for 256 more, and the largest diameter of the window meanwhile.
struct Visit {
    std::vector<glm::vec4> away, back;
    float diameter = 0.0F;
};

constexpr BundleResolution resolution{64, 96};
const glm::vec3 box_home(1, 0, 1);

std::vector<glm::vec4> walls_of(const SceneBuilder& b, const Solver& solver) {
    std::vector<glm::vec4> walls = solver.store().read_irradiance();
    std::size_t count = 0;
    while (b.mesh.vertex_object[b.mesh.triangles[count].x] == 0) {
        ++count;
    }
    walls.resize(count);
    return walls;
}

Visit visit(const glm::vec3& place) {
    const SceneBuilder b = room_with_box(box_home);
    Solver solver(b.scene, b.mesh, quick_settings(1, resolution));
    Visit visit;
    const auto iterate_measured = [&](std::uint64_t count) {
        visit.diameter = std::max(visit.diameter, solver.scene().diameter());
        iterate(solver, count);
        visit.diameter = std::max(visit.diameter, solver.scene().diameter());
    };
    iterate_measured(128);
    move_box(solver, place);
    iterate_measured(128);
    visit.away = walls_of(b, solver);
    move_box(solver, box_home);
    iterate_measured(256);
    visit.back = walls_of(b, solver);
    return visit;
}

double fresh_mean(bool with_box) {
    SceneBuilder b = room_with_box(box_home);
    b.scene.objects[box_object].transform.scale = glm::vec3(with_box ? 1.0F : 0.0F);
    Solver fresh(b.scene, b.mesh, quick_settings(2, resolution));
    iterate(fresh, 384);
    return mean(walls_of(b, fresh));
}

/// The window stays, the walls' light is within 3 % of a fresh solve, and how far away the box has
/// been makes no difference to any bit.
TEST(FarCoordinates, AnObjectThatIsFarAwayChangesNeitherWindowNorLight) {
    const Visit near = visit({500, 0, 0});
    const float diameter = Solver(room_with_box(box_home).scene, room_with_box(box_home).mesh,
                                  quick_settings(1, resolution))
                               .scene()
                               .diameter();
    const double without = fresh_mean(false);
    const double with = fresh_mean(true);
    EXPECT_NEAR(mean(near.away), without, 0.03 * without);
    EXPECT_NEAR(mean(near.back), with, 0.03 * with);
    EXPECT_EQ(near.diameter, diameter);
    for (const glm::vec3& place : {glm::vec3(0, -500, 300), glm::vec3(5e6F, 0, 0)}) {
        const Visit far = visit(place);
        EXPECT_EQ(far.diameter, diameter);
        EXPECT_EQ(far.away, near.away);
        EXPECT_EQ(far.back, near.back);
    }
}

}  // namespace
}  // namespace raybundle::far_coordinates_test
