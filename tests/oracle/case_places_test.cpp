// SPDX-License-Identifier: Apache-2.0
// Places of tests/cases: a furnace of small, thin and touching things, a corridor, a frosted globe.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scene/gltf/gltf_loader.h"
#include "scene/mesh/patch_mesh.h"
#include "transport/patch_area.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::case_places_test {
namespace {

const std::string places = RAYBUNDLE_CASES "/places/";

/// Every surface emits 100 cd/m² and reflects 0.7 of what it receives.
constexpr double furnace_irradiance = 3.14159265358979 * 100.0 / (1.0 - 0.7);  // lx

glm::vec3 centre_of(const PatchMesh& mesh, std::size_t patch) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[patch]];
    return (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0F;
}

/// Area mean of the room's irradiance over the furnace's, without the floor round the three boxes
/// that stand on it, where patches are covered in part.
double furnace_level(std::uint64_t seed) {
    Scene scene = load_gltf(places + "furnace.gltf");
    TessellationSettings tessellation;
    tessellation.patch_size = 0.3F;
    tessellation.join_triangles = false;  // each patch is a side of one triangle
    const PatchMesh mesh = tessellate(scene, tessellation);
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = {128, 256};
    settings.coarse_iterations = 10'000;
    Solver solver(scene, mesh, settings);
    while (solver.iterations() < 800) {
        solver.step({});
    }
    const auto irradiance = solver.store().read_irradiance();
    double sum = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const glm::vec3 c = centre_of(mesh, i);
        const std::uint32_t object = mesh.vertex_object[mesh.triangles[mesh.side_triangle[i]].x];
        if (object == 0 && c.y > 1e-3F) {
            const double area = world_area(scene, mesh, i);
            sum += area * static_cast<double>(irradiance[i].x);
            total += area;
        }
    }
    return sum / total / furnace_irradiance;
}

TEST(CasesPlaces, FurnaceOfSmallThinAndTouchingThingsKeepsItsLevel) {
    for (const std::uint64_t seed : {4U, 5U}) {
        EXPECT_NEAR(furnace_level(seed), 1.0, 0.015) << "seed " << seed;
    }
}

double mean_luminance(ViewerImage& image) {
    const auto picture = image.read_radiance();
    double sum = 0.0;
    for (const glm::vec4& pixel : picture) {
        sum += static_cast<double>(pixel.g);
    }
    return sum / static_cast<double>(picture.size());
}

/// Round five bends from the lamp light comes late, and what has not come does not scatter.
TEST(CasesPlaces, CorridorIsUnknownWhileItsLightStillRises) {
    Scene scene = load_gltf(places + "corridor.gltf");
    TessellationSettings tessellation;
    tessellation.patch_size = 0.25F;
    const PatchMesh mesh = tessellate(scene, tessellation);
    SolverSettings settings;
    settings.coarse = {128, 256};
    settings.coarse_iterations = 10'000;
    Solver solver(scene, mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {48, 36});
    Camera camera;
    camera.eye = {9.75F, 1.6F, 10.35F};
    camera.target = {9.75F, 1.0F, 7.8F};
    camera.vertical_fov = 1.309F;
    image.set_camera(camera);
    image.rest();
    BundleReceiver* const receivers[] = {&image};
    double lit = 0.0;
    double high = 1.0;
    for (int i = 1; i <= 2048; ++i) {
        solver.step(receivers);
        if (i == 512 || i == 1024 || i == 2048) {
            const double now = mean_luminance(image);
            EXPECT_GE(high, 1.0 - lit / now) << i / 2 << " iterations";  // 0.1 to 0.17 by scatter
            image.request_statistics();
            image.finish_statistics();
            lit = now;
            high = image.statistics().error_high;
        }
    }
}

struct GlobePicture {
    std::vector<glm::vec4> pixels;
    double noise = 0.0;  ///< relative, as the picture states it
};

/// The lower half of the globe and nothing else.
GlobePicture picture_of_globe(std::uint64_t seed) {
    Scene scene = load_gltf(places + "globe_frosted.gltf");
    TessellationSettings tessellation;
    tessellation.patch_size = 0.15F;
    const PatchMesh mesh = tessellate(scene, tessellation);
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = {128, 256};
    Solver solver(scene, mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {32, 24});
    Camera camera;
    camera.eye = {2.0F, 1.0F, 1.9F};
    camera.target = {2.0F, 2.3F, 2.0F};
    camera.vertical_fov = 0.2F;
    image.set_camera(camera);
    image.rest();
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 256; ++i) {
        solver.step(receivers);
    }
    image.request_statistics();
    image.finish_statistics();
    return {image.read_radiance(), image.statistics().noise};
}

/// What comes through frosted glass is known per patch: a pixel has no samples of it that scatter.
TEST(CasesPlaces, FrostedGlobeKnowsTheNoiseOfWhatComesThrough) {
    const GlobePicture one = picture_of_globe(1);
    const GlobePicture other = picture_of_globe(2);
    double differences = 0.0;
    double light = 0.0;
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        const auto a = static_cast<double>(one.pixels[i].g);
        const auto b = static_cast<double>(other.pixels[i].g);
        differences += 0.5 * (a - b) * (a - b);
        light += 0.5 * (a * a + b * b);
    }
    const double noise = std::sqrt(differences / light);
    // Two pictures say it to within a factor of 2, since all that comes through has one level.
    for (const GlobePicture* picture : {&one, &other}) {
        EXPECT_GT(picture->noise, 0.25 * noise);  // 0.01 of it without what comes through
        EXPECT_LT(picture->noise, 4.0 * noise);
    }
}

}  // namespace
}  // namespace raybundle::case_places_test
