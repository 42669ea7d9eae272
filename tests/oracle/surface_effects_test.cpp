// SPDX-License-Identifier: Apache-2.0
// The shipped scenes of what textures and vertices do to a surface, against path tracing.
#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "../unit/gltf_builder.h"
#include "pictures.h"
#include "scene/effects/effect_removal.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/material/specular_surface.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::surface_effects_test {
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
    SolverSettings settings;
    settings.coarse = {160, 250};
    settings.coarse_iterations = 1'000'000;
    Solver solver(loaded.scene, loaded.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(loaded.scene.cameras.front());
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < iterations; ++i) {
        solver.step(receivers);
    }
    return image.read_radiance();
}

/// With 256 paths a pixel has a noise of 1.3 %, the whole picture one of 0.4 % (SharedPaths): the
/// blocks that are compared lie between, and their bounds are 3 %.
std::vector<glm::dvec3> path_traced(const LoadedScene& loaded, std::uint32_t paths = 256) {
    return path_traced_centres(loaded.scene, loaded.mesh, loaded.scene.cameras.front(), size,
                               paths);
}

class SharedPaths : public testing::TestWithParam<const char*> {};

/// What the pictures here are compared with: neighbours that share their paths show what each pixel
/// does by itself. The product of the differences from two independent pictures has no noise of
/// either, but the shared picture's own: 0.9 %. Its mean is off by 0.3 % at most, and with twelve
/// times as many samples by 0.08 % (tiles of 5 x 5 pixels).
TEST_P(SharedPaths, ShowWhatPathsOfSinglePixelsDo) {
    const LoadedScene loaded = load_effect(GetParam());
    const RayScene rays(loaded.scene, loaded.mesh);
    const LightSampling lights(rays);
    const CameraRays camera(rays, loaded.scene.cameras.front(), size);
    const PathTracer tracer(rays, lights);
    const auto single = [&](std::uint64_t seed) {
        ImageEstimate image(size, seed);
        for (int i = 0; i < 512; ++i) {
            image.add_pass(camera, [&](const glm::dvec3& origin, const glm::dvec3& direction,
                                       PixelSampler& sampler) {
                return tracer.radiance(origin, direction, sampler);
            });
        }
        return image.means();
    };
    const PathReuse sharing(rays, lights);
    ImageEstimate shared(size, 3);
    for (int i = 0; i < 512; ++i) {
        sharing.add_pass(shared, camera);
    }
    const auto a = single(1);
    const auto b = single(2);
    double product = 0.0;
    double total = 0.0;
    glm::dvec3 difference(0.0);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 found = shared.mean(i);
        product += glm::dot(found - a[i], found - b[i]);
        total += glm::dot(found, found);
        difference += found - 0.5 * (a[i] + b[i]);
        sum += found;
    }
    EXPECT_LT(product / total, 0.015 * 0.015);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(difference[c], 0.0, 0.005 * sum[c]) << c;
    }
}

INSTANTIATE_TEST_SUITE_P(Effects, SharedPaths,
                         testing::Values("diffuse_transmission", "normal_map", "roughness_texture",
                                         "clear_coat", "polished"),
                         [](const auto& test) { return std::string(test.param); });

TEST(SurfaceEffects, NormalMapIsAsByPathTracing) {
    LoadedScene loaded = load_effect("normal_map");
    const auto picture = solved(loaded, 384);
    const auto truth = path_traced(loaded);
    EXPECT_LT(block_difference(picture, truth, size, block), 0.03);
    // Pixel by pixel, since blocks average studs away.
    const double with_map = block_difference(picture, truth, size, 1);
    ASSERT_TRUE(remove_effect("normal-maps", loaded.scene, loaded.mesh));
    const double without = block_difference(picture, path_traced(loaded, 192), size, 1);
    EXPECT_LT(with_map, 0.06);
    EXPECT_GT(without, 2.0 * with_map);
}

TEST(HeavySurfaceEffects, RoughnessTextureIsAsByPathTracing) {
    LoadedScene loaded = load_effect("roughness_texture");
    const auto picture = solved(loaded, 640);
    EXPECT_LT(block_difference(picture, path_traced(loaded), size, block), 0.03);
    for (Material& material : loaded.scene.materials) {
        material.metallic_roughness_texture.texture = -1;
    }
    loaded.mesh.metallic_roughness.clear();
    EXPECT_GT(block_difference(picture, path_traced(loaded, 128), size, block), 0.06);
}

/// Smooth coats, which view rays show, and a satin one, which bundles do.
TEST(SurfaceEffects, ClearCoatIsAsByPathTracing) {
    LoadedScene loaded = load_effect("clear_coat");
    Camera& flat = loaded.scene.cameras.front();  // along the boards, which reflect more so
    flat.eye = {2.0F, 0.5F, -1.0F};
    flat.target = {2.0F, 0.2F, 2.5F};
    const auto picture = solved(loaded, 640);
    EXPECT_LT(block_difference(picture, path_traced(loaded), size, block), 0.03);
    // Half as much again as the bound: without coats the picture is 5.6 % off.
    ASSERT_TRUE(remove_effect("clear-coat", loaded.scene, loaded.mesh));
    EXPECT_GT(block_difference(picture, path_traced(loaded, 128), size, block), 0.045);
}

/// Dielectrics that mirror, which view rays show over what is below.
TEST(SurfaceEffects, PolishedSurfacesAreAsByPathTracing) {
    LoadedScene loaded = load_effect("polished");
    Camera& flat = loaded.scene.cameras.front();
    flat.eye = {2.0F, 0.7F, -1.0F};
    flat.target = {2.0F, 0.2F, 2.5F};
    const auto picture = solved(loaded, 384);
    EXPECT_LT(block_difference(picture, path_traced(loaded), size, block), 0.03);
    for (Material& material : loaded.scene.materials) {
        material.specular = has_smooth_lobe(material) ? 0.0F : material.specular;
    }
    // Seen: 7 %.
    EXPECT_GT(block_difference(picture, path_traced(loaded, 128), size, block), 0.05);
}

TEST(HeavySurfaceEffects, VertexColoursAreAsByPathTracing) {
    LoadedScene loaded = load_effect("vertex_colours");
    const auto picture = solved(loaded, 320);
    EXPECT_LT(block_difference(picture, path_traced(loaded), size, block), 0.03);
}

TEST(SurfaceEffects, LightThroughACurtainIsAsByPathTracing) {
    LoadedScene loaded = load_effect("diffuse_transmission");
    const auto picture = solved(loaded, 512);
    EXPECT_LT(block_difference(picture, path_traced(loaded), size, block), 0.03);
    ASSERT_TRUE(remove_effect("diffuse-transmission", loaded.scene, loaded.mesh));
    EXPECT_GT(block_difference(picture, path_traced(loaded, 64), size, block), 0.1);
}

/// A horizontal sheet of 2 m, and sunlight of 100 lx straight from above.
Scene sheet_in_the_sun() {
    test::GltfBuilder builder;
    const int positions = builder.add_positions({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}});
    const int material =
        builder.add_material({{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}}},
                              {"extensions",
                               {{"KHR_materials_diffuse_transmission",
                                 {{"diffuseTransmissionFactor", 0.4},
                                  {"diffuseTransmissionColorFactor", {1, 0.5, 0.25}}}}}}});
    const int mesh = builder.add_mesh({{"attributes", {{"POSITION", positions}}},
                                       {"indices", builder.add_indices({0, 1, 2, 0, 2, 3})},
                                       {"material", material}});
    builder.add_node({{"mesh", mesh}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 100}}};
    const double half = std::sqrt(0.5);
    builder.add_node({{"rotation", {-half, 0, 0, half}},
                      {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return builder.load();
}

// rho E / pi from above, tau E / pi from below.
TEST(SurfaceEffects, ASheetInTheSunSendsItsShareToEitherSide) {
    Scene scene = sheet_in_the_sun();
    TessellationSettings tessellation;
    tessellation.patch_size = 0.5F;
    const PatchMesh mesh = tessellate(scene, tessellation);
    Solver solver(scene, mesh);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, glm::uvec2(4, 4));
    BundleReceiver* const receivers[] = {&image};
    const RayScene rays(scene, mesh);
    const LightSampling lights(rays);
    const PathTracer tracer(rays, lights);
    for (const float side : {1.0F, -1.0F}) {
        Camera camera;
        camera.eye = {0.0F, 2.0F * side, 0.0F};
        camera.target = glm::vec3(0.0F);
        camera.up = {0.0F, 0.0F, -1.0F};
        image.set_camera(camera);
        for (int i = 0; i < 16; ++i) {
            solver.step(receivers);
        }
        const double e_over_pi = 100.0 / glm::pi<double>();
        const glm::dvec3 exact =
            e_over_pi * (side > 0.0F ? 0.6 * glm::dvec3(0.5, 0.25, 1.0)
                                     : 0.999 * 0.4 * glm::dvec3(1.0, 0.5, 0.25));
        const glm::dvec3 shown(image.read_radiance()[5]);
        glm::dvec3 traced(0.0);
        constexpr int paths = 4096;
        for (int i = 0; i < paths; ++i) {
            PixelSampler path(1, 0, 0, static_cast<std::uint32_t>(i));
            traced += tracer.radiance(rays.from_world({0.1, 2.0 * side, 0.1}),
                                      {0.0, -static_cast<double>(side), 0.0}, path);
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(shown[c], exact[c], 0.01 * exact[c] + 0.01) << side;
            // A share of at least a fifth is followed: 4 standard deviations of 4096 choices.
            EXPECT_NEAR(traced[c] / paths, exact[c], 0.13 * exact[c]) << side;
        }
    }
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
}  // namespace raybundle::surface_effects_test
