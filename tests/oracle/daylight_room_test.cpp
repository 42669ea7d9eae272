// SPDX-License-Identifier: Apache-2.0
// A shipped scene in which nothing but daylight lights the picture, against path tracing.
#include <gtest/gtest.h>

#include "pictures.h"
#include "scene/gltf/gltf_loader.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::daylight_room_test {
namespace {

constexpr glm::uvec2 size(24, 18);

/// Relative RMS difference over blocks of 6 x 6 pixels.
double room_difference(const char* name, int iterations, std::uint32_t paths) {
    Scene scene = load_gltf(std::string(RAYBUNDLE_SCENES) + "/effects/" + name + ".gltf");
    TessellationSettings tessellation;
    tessellation.target_patches = 4000;
    const PatchMesh mesh = tessellate(scene, tessellation);
    Solver solver(scene, mesh);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(scene.cameras.front());
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < iterations; ++i) {
        solver.step(receivers);
    }
    const auto truth = path_traced_centres(scene, mesh, scene.cameras.front(), size, paths);
    return block_difference(image.read_radiance(), truth, size, 6);
}

TEST(DaylightRoom, ClearSkyIsAsBrightAsByPathTracing) {
    EXPECT_LT(room_difference("clear_sky", 640, 2048), 0.03);
}

}  // namespace
}  // namespace raybundle::daylight_room_test
