// SPDX-License-Identifier: Apache-2.0
// The shipped scenes of what textures and vertices do to a surface, against path tracing.
#include <gtest/gtest.h>

#include "pictures.h"
#include "scene/effects_plan.h"
#include "scene/gltf_loader.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {
namespace {

constexpr glm::uvec2 size(24, 18);
constexpr unsigned block = 6;  // pixels along one whose mean is compared

struct LoadedScene {
    Scene scene;
    PatchMesh mesh;
};

LoadedScene load_effect(const std::string& name) {
    LoadedScene loaded{load_gltf(std::string(RAYBUNDLE_SCENES) + "/effects/" + name + ".gltf"), {}};
    TessellationSettings tessellation;
    tessellation.target_patches = 4000;
    loaded.mesh = tessellate(loaded.scene, tessellation);
    return loaded;
}

std::vector<glm::vec4> solved(const LoadedScene& loaded, int iterations) {
    Solver solver(loaded.scene, loaded.mesh);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(loaded.scene.cameras.front());
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < iterations; ++i) {
        solver.step(receivers);
    }
    return image.read_radiance();
}

std::vector<glm::dvec3> path_traced(const LoadedScene& loaded, std::uint32_t paths) {
    return path_traced_centres(loaded.scene, loaded.mesh, loaded.scene.cameras.front(), size,
                               paths);
}

TEST(SurfaceEffects, NormalMapIsAsByPathTracing) {
    LoadedScene loaded = load_effect("normal_map");
    const auto picture = solved(loaded, 384);
    const auto truth = path_traced(loaded, 768);
    EXPECT_LT(block_difference(picture, truth, size, block), 0.03);
    // Pixel by pixel, since blocks average studs away.
    const double with_map = block_difference(picture, truth, size, 1);
    ASSERT_TRUE(remove_effect("normal-maps", loaded.scene, loaded.mesh));
    const double without = block_difference(picture, path_traced(loaded, 192), size, 1);
    EXPECT_LT(with_map, 0.06);
    EXPECT_GT(without, 2.0 * with_map);
}

TEST(SurfaceEffects, RoughnessTextureIsAsByPathTracing) {
    LoadedScene loaded = load_effect("roughness_texture");
    const auto picture = solved(loaded, 640);
    EXPECT_LT(block_difference(picture, path_traced(loaded, 768), size, block), 0.03);
    for (Material& material : loaded.scene.materials) {
        material.metallic_roughness_texture.texture = -1;
    }
    loaded.mesh.metallic_roughness.clear();
    EXPECT_GT(block_difference(picture, path_traced(loaded, 128), size, block), 0.06);
}

TEST(SurfaceEffects, VertexColoursAreAsByPathTracing) {
    LoadedScene loaded = load_effect("vertex_colours");
    const auto picture = solved(loaded, 320);
    EXPECT_LT(block_difference(picture, path_traced(loaded, 384), size, block), 0.03);
}

TEST(SurfaceEffects, UnlitSurfacesShowTheirColourWhateverLightsThem) {
    const LoadedScene loaded = load_effect("unlit");
    const auto picture = solved(loaded, 256);
    const auto truth = path_traced(loaded, 256);
    EXPECT_LT(block_difference(picture, truth, size, block), 0.03);
    const glm::dvec3 colour = double{unlit_white} * glm::dvec3(0.05, 0.45, 0.2);
    std::size_t shown = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (glm::distance(truth[i], colour) < 1e-4) {
            ++shown;
            // Eight bits, square-root encoded.
            EXPECT_LT(glm::distance(glm::dvec3(picture[i]), colour), 0.01 * glm::length(colour));
        }
    }
    EXPECT_GE(shown, 16U);
}

}  // namespace
}  // namespace raybundle
