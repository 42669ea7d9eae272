// SPDX-License-Identifier: Apache-2.0
// The outside of a lamp's shade is thinner than a bundle's pixel away from the lamp.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "oracle/scene_builder.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::shade_test {
namespace {

/// A square tube of 10 cm whose walls are 6 mm thick, a lamp 25 mm below its upper end, in a black
/// room of 8 m: nothing can light the tube's outside.
SceneBuilder shaded_lamp() {
    SceneBuilder b;
    const auto black = b.add_material(glm::vec3(0.0F));
    const auto brass = b.add_material(glm::vec3(0.5F));
    const auto lamp = b.add_material(glm::vec3(0.5F), glm::vec3(1e4F));
    b.add_box({-4, -2, -4}, {4, 2, 4}, true, 2, black);
    b.add_box({-0.05F, -0.1F, -0.05F}, {0.05F, 0.1F, 0.05F}, false, 1, brass);
    // Its upper face gives way to a rim, an inner wall and the lamp.
    for (std::size_t t = 0; t < b.mesh.triangles.size(); ++t) {
        const glm::vec3 c = b.cell_centre(t);
        if (b.mesh.triangle_material[t] == brass && c.y > 0.099F) {
            b.set_triangle_material(t, black);  // lowered to where the lamp is, by its vertices
            for (int k = 0; k < 3; ++k) {
                b.mesh.positions[b.mesh.triangles[t][k]].y = 0.07F;
            }
        }
    }
    const float in = 0.044F;
    const float out = 0.05F;
    b.add_quad({-in, 0.075F, -in}, {0, 0, 2 * in}, {2 * in, 0, 0}, 1, 1, lamp);
    for (int side = 0; side < 4; ++side) {
        b.set_transform(glm::rotate(glm::mat4(1.0F), glm::radians(90.0F * static_cast<float>(side)),
                                    glm::vec3(0, 1, 0)));
        b.add_quad({-in, 0.075F, -in}, {2 * in, 0, 0}, {0, 0.025F, 0}, 1, 1, brass);
        b.add_quad({-out, 0.1F, -out}, {0, 0, out - in}, {2 * out, 0, 0}, 1, 1, brass);
    }
    return b;
}

TEST(Shade, ItsOutsideIsDark) {
    const SceneBuilder b = shaded_lamp();
    SolverSettings settings;
    settings.coarse = {128, 200};
    Solver solver(b.scene, b.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {64, 96});
    Camera camera;
    camera.eye = {0.3F, 0.02F, 0.5F};
    camera.target = {0, 0, 0};
    camera.vertical_fov = 0.34F;
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    while (solver.iterations() < 256) {
        solver.step(receivers);
    }
    float brightest = 0.0F;
    for (const glm::vec4& value : image.read_radiance()) {
        brightest = std::max(brightest, value.x);
    }
    EXPECT_EQ(brightest, 0.0F);  // 546 cd/m² where the lamp counts as in front
}

}  // namespace
}  // namespace raybundle::shade_test
