// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>

#include "oracle/scene_builder.h"
#include "scene/mesh/patch_mesh.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::alpha_mask_test {
namespace {

void add_quad(Scene& scene, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v,
              std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec2 uv :
         {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        scene.vertices.push_back({corner + uv.x * u + uv.y * v, normal, uv});
        scene.bounds.add(scene.vertices.back().position);
    }
    scene.triangles.push_back({{first, first + 1, first + 2}, material, 0});
    scene.triangles.push_back({{first, first + 2, first + 3}, material, 0});
    scene.objects[0].bounds = scene.bounds;
}

/// 32 x 32 texels of which every other one is transparent.
Texture chequered() {
    Texture texture;
    texture.width = texture.height = 32;
    for (int i = 0; i < 32 * 32; ++i) {
        const bool there = (i % 32 + i / 32) % 2 == 0;
        texture.rgba.insert(texture.rgba.end(), {255, 255, 255});
        texture.rgba.push_back(there ? 255 : 0);
    }
    return texture;
}

enum class Screen { none, chequered, opaque };

/// A floor (material 0), a lamp above it and a black screen of 3 m between them.
Scene lit_floor(Screen screen, float height = 1.5F) {
    Scene scene;
    scene.objects.emplace_back();
    scene.textures.push_back(chequered());
    for (int i = 0; i < 3; ++i) {
        Material material;
        material.metallic = 0.0F;
        material.specular = 0.0F;
        material.base_colour = glm::vec3(i == 0 ? 0.5F : 0.0F);
        scene.materials.push_back(material);
    }
    scene.materials[1].emission = glm::vec3(1000.0F);
    if (screen == Screen::chequered) {
        scene.materials[2].alpha_mode = AlphaMode::mask;
        scene.materials[2].base_colour_texture.texture = 0;
    }
    add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 0);
    add_quad(scene, {-0.5F, 3, -0.5F}, {1, 0, 0}, {0, 0, 1}, 1);
    if (screen != Screen::none) {
        add_quad(scene, {-1.5F, height, -1.5F}, {0, 0, 3}, {3, 0, 0}, 2);
    }
    return scene;
}

/// Mean irradiance of the floor in the solution, and luminance of its middle in a picture.
struct Lighting {
    double floor = 0.0, picture = 0.0;
};

Lighting measure(Screen screen, const StrategyProbabilities& probabilities) {
    Scene scene = lit_floor(screen);
    TessellationSettings tessellation;
    tessellation.patch_size = 0.25F;
    const PatchMesh mesh = tessellate(scene, tessellation);
    SolverSettings settings;
    settings.probabilities = probabilities;
    settings.coarse = {256, 400};
    settings.coarse_iterations = 1'000'000;
    Solver solver(scene, mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {32, 32});
    Camera camera;
    camera.eye = {0.01F, 1.2F, 0.0F};
    camera.target = {0.0F, 0.0F, 0.0F};
    camera.up = {0, 0, 1};
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 512; ++i) {
        solver.step(receivers);
    }
    Lighting result;
    int patches = 0;
    const auto irradiance = solver.store().read_irradiance();
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        if (mesh.triangle_material[mesh.side_triangle[i]] == 0) {
            result.floor += static_cast<double>(irradiance[i].g);
            ++patches;
        }
    }
    result.floor /= patches;
    for (const glm::vec4& pixel : image.read_radiance()) {
        result.picture += static_cast<double>(pixel.g) / (32.0 * 32.0);
    }
    return result;
}

/// Luminance of the floor right below a texel of the screen, which hangs 8 mm above it, so near
/// that pixels follow their own rays.
double below(Screen screen, unsigned row, unsigned column) {
    Scene scene = lit_floor(screen, 0.008F);
    TessellationSettings tessellation;
    tessellation.patch_size = 0.25F;
    const PatchMesh mesh = tessellate(scene, tessellation);
    SolverSettings settings;
    settings.probabilities = {1.0F, 0.0F, 0.0F};
    Solver solver(scene, mesh, settings);
    const ViewPrograms programs(solver.scene());
    constexpr glm::uvec2 size(8, 8);
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    const auto middle = [](unsigned texel) {
        return -1.5F + 3.0F / 32.0F * (static_cast<float>(texel) + 0.5F);
    };
    Camera camera;
    camera.target = {middle(row), 0.0F, middle(column)};
    camera.eye = camera.target + glm::vec3(0.0F, 0.004F, 0.02F);
    camera.vertical_fov = 0.1F;
    image.set_camera(camera);
    image.rest();
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 256; ++i) {
        solver.step(receivers);
    }
    double sum = 0.0;
    for (const glm::vec4& pixel : image.read_radiance()) {
        sum += static_cast<double>(pixel.g) / (size.x * size.y);
    }
    return sum;
}

TEST(AlphaMaskNearby, LetsLightThroughItsHoles) {
    const double open = below(Screen::none, 17, 16);
    EXPECT_GT(open, 0.0);
    EXPECT_NEAR(below(Screen::chequered, 17, 16) / open, 1.0, 0.05);
    // The object-space value there, of about a texel's width, still counts as six samples of 256.
    EXPECT_LT(below(Screen::chequered, 16, 16) / open, 1.1 * 6.0 / 262.0);
    EXPECT_EQ(below(Screen::opaque, 17, 16), 0.0);
}

class AlphaMask : public testing::TestWithParam<StrategyProbabilities> {};

/// Half of the light passes through a screen of which every other texel is transparent; the texels
/// are much smaller than the patches, which alone could not tell.
TEST_P(AlphaMask, LetsLightThroughItsHoles) {
    const Lighting open = measure(Screen::none, GetParam());
    const Lighting half = measure(Screen::chequered, GetParam());
    const Lighting closed = measure(Screen::opaque, GetParam());
    EXPECT_GT(open.floor, 0.0);
    EXPECT_EQ(closed.floor, 0.0);
    EXPECT_NEAR(half.floor / open.floor, 0.5, 0.03);
    EXPECT_NEAR(half.picture / open.picture, 0.5, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Strategies, AlphaMask,
                         testing::Values(StrategyProbabilities{0.0F, 0.0F, 1.0F},
                                         StrategyProbabilities{1.0F, 0.0F, 0.0F}));

}  // namespace
}  // namespace raybundle::alpha_mask_test
