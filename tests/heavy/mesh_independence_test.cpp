// SPDX-License-Identifier: Apache-2.0
// Pixels receive for themselves, so what a picture converges to hardly depends on the patches.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scene/gltf/gltf_loader.h"
#include "scene/mesh/patch_mesh.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {
namespace {

std::vector<glm::vec4> picture(const Scene& scene, const PatchMesh& mesh, std::uint64_t seed) {
    SolverSettings settings;
    settings.seed = seed;
    Solver solver(scene, mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {128, 96});
    image.set_camera(scene.cameras.front());
    BundleReceiver* receivers[] = {&image};
    while (solver.iterations() < 3000) {
        solver.step(receivers);
    }
    return image.read_radiance();
}

/// Two pictures of each mesh: the mean of (a1 - b1)(a2 - b2) is the squared difference between the
/// meshes without the noise.
double relative_difference(const std::vector<glm::vec4>& a1, const std::vector<glm::vec4>& a2,
                           const std::vector<glm::vec4>& b1, const std::vector<glm::vec4>& b2) {
    double product = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < a1.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const auto of = [&](const std::vector<glm::vec4>& p) {
                return static_cast<double>(p[i][c]);
            };
            product += (of(a1) - of(b1)) * (of(a2) - of(b2));
            squares += of(a1) * of(a2);
        }
    }
    return std::sqrt(std::max(product, 0.0) / squares);
}

/// Half the edge in the living room, 29 758 and 66 474 patches: less than 1 % relRMSE.
TEST(MeshIndependence, HalfThePatchSizeShowsTheSamePicture) {
    const auto pictures = [](float edge, std::vector<std::vector<glm::vec4>>& result) {
        Scene scene = load_gltf(std::string(RAYBUNDLE_SCENES) + "/living_room.gltf");
        TessellationSettings settings;
        settings.patch_size = edge;
        const PatchMesh mesh = tessellate(scene, settings);
        for (const std::uint64_t seed : {1U, 2U}) {
            result.push_back(picture(scene, mesh, seed));
        }
    };
    std::vector<std::vector<glm::vec4>> p;
    for (const float edge : {0.7F, 0.35F}) {
        pictures(edge, p);
    }
    const double difference = relative_difference(p[0], p[1], p[2], p[3]);
    RecordProperty("relative_difference", std::to_string(difference));
    EXPECT_LT(difference, 0.01);
    EXPECT_GT(difference, 1e-4) << "the meshes were the same";
}

}  // namespace
}  // namespace raybundle
