// SPDX-License-Identifier: Apache-2.0
// What does not fit into the memory of the GPU, and a GPU that fails.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "daemon.h"
#include "gpu/egl_context.h"
#include "json_viewer.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/mesh/patch_mesh.h"
#include "test_folder.h"
#include "transport/solver.h"

namespace raybundle {
namespace {

/// A hemicube and a window of 16384 pixels are larger than any driver's textures.
TEST(GlMemory, BundlesStayCoarseWhereFineOnesDoNotFit) {
    const EglContext context = create_egl_context();
    Scene scene = load_gltf(scene_file("cornell_box.gltf"));
    const PatchMesh mesh = tessellate(scene);
    SolverSettings settings;
    settings.coarse = {64, 100};
    settings.fine = {16384, 16384};
    settings.coarse_iterations = 8;
    settings.fine_noise = 1e9F;
    Solver solver(scene, mesh, settings);
    while (solver.iterations() < 40) {
        ASSERT_NO_THROW(solver.step({}));
    }
    EXPECT_EQ(solver.resolution().window, settings.coarse.window);
    const glm::vec3 floor = solver.store().read_irradiance(0);
    EXPECT_TRUE(std::isfinite(floor.x) && floor.x > 0.0F) << floor.x;
}

/// The server loses its GPU soon after each change.
class GpuLossTest : public testing::Test {
  protected:
    // NOLINTBEGIN(concurrency-mt-unsafe)
    GpuLossTest() { setenv("RAYBUNDLE_TEST_GPU_LOST_AFTER", "8", 1); }
    ~GpuLossTest() override { unsetenv("RAYBUNDLE_TEST_GPU_LOST_AFTER"); }
    // NOLINTEND(concurrency-mt-unsafe)
};

TEST_F(GpuLossTest, TheSceneIsBuiltAnewWithItsChangesUntilThatHelpsNoMore) {
    const TestFolder folder;
    Daemon daemon(scene_file("cornell_box.gltf"), {"--journal", folder.path("session.db")});
    for (unsigned epoch = 0; epoch < 3; ++epoch) {
        JsonViewer viewer(daemon.port());
        const Json welcome = viewer.join();
        ASSERT_TRUE(welcome.contains("welcome")) << welcome.dump();
        EXPECT_EQ(welcome.at("welcome").at("epoch"), epoch);
        const Json moved = viewer.request(
            {{"moveObject",
              {{"object", 2}, {"transform", {{"translation", {{"x", 2.0 + 0.1 * epoch}}}}}}}});
        EXPECT_EQ(moved.at("sceneChanged").at("epoch"), epoch + 1) << moved.dump();
        EXPECT_EQ(viewer.close_code(), epoch < 2 ? 1012 : 1001);
    }
    EXPECT_EQ(daemon.wait(), 4);
    EXPECT_TRUE(daemon.says("smaller bundles have not helped"));
}

}  // namespace
}  // namespace raybundle
