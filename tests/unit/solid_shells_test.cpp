// SPDX-License-Identifier: Apache-2.0
// doubleSided surfaces that are the outside of something solid have no inside.
#include "scene/contact/solid_shells.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "scene/material/specular_surface.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle {
namespace {

Scene empty_scene() {
    Scene scene;
    scene.materials.emplace_back().double_sided = true;
    scene.objects.emplace_back();
    return scene;
}

/// A box whose fronts look outwards, of 12 triangles that share no vertices, in an object of its
/// own.
void add_box(Scene& scene, const glm::vec3& low, const glm::vec3& high, bool outwards = true,
             std::uint32_t material = 0) {
    constexpr std::array<std::array<int, 4>, 6> faces = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    const auto object = static_cast<std::uint32_t>(scene.objects.size());
    scene.objects.emplace_back();
    for (const auto& face : faces) {
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (const int corner : face) {
            const glm::vec3 at((corner & 1) != 0 ? high.x : low.x,
                               (corner & 2) != 0 ? high.y : low.y,
                               (corner & 4) != 0 ? high.z : low.z);
            scene.vertices.push_back({at, glm::vec3(0, 0, 1), glm::vec2(0)});
        }
        const std::uint32_t b = outwards ? 1 : 2;
        const std::uint32_t c = outwards ? 2 : 1;
        scene.triangles.push_back({{first, first + b, first + c}, material, object});
        scene.triangles.push_back({{first, first + 1 + b, first + 1 + c}, material, object});
    }
}

std::size_t solid_triangles(const Scene& scene, std::uint32_t object) {
    std::size_t count = 0;
    for (const Triangle& triangle : scene.triangles) {
        count += triangle.object == object && triangle.solid ? 1 : 0;
    }
    return count;
}

TEST(SolidShells, ABoxIsSolidOnTheSideThatItTurnsAway) {
    Scene scene = empty_scene();
    add_box(scene, {0, 0, 0}, {1, 2, 3});
    add_box(scene, {5, 0, 0}, {6, 2, 3}, false);
    EXPECT_EQ(mark_solid_shells(scene), 12U);
    EXPECT_EQ(solid_triangles(scene, 1), 12U);
    EXPECT_FALSE(two_sided(scene, scene.triangles[0]));
    EXPECT_TRUE(two_sided(scene, scene.triangles[12]));
}

TEST(SolidShells, AMirroredObjectCountsByWhatItIsInTheWorld) {
    Scene scene = empty_scene();
    add_box(scene, {0, 0, 0}, {1, 2, 3});
    scene.objects[1].world_from_parent = glm::scale(glm::mat4(1.0F), glm::vec3(-1, 1, 1));
    EXPECT_EQ(mark_solid_shells(scene), 0U);  // its fronts look inwards now
}

TEST(SolidShells, HaveNoPatchesWithin) {
    Scene scene = empty_scene();
    add_box(scene, {0, 0, 0}, {1, 2, 3});
    Scene open = scene;
    open.triangles.pop_back();
    mark_solid_shells(scene);
    EXPECT_EQ(mark_solid_shells(open), 0U);
    TessellationSettings settings;
    settings.patch_size = 0.4F;
    const PatchMesh solid = tessellate(scene, settings);
    const PatchMesh sheet = tessellate(open, settings);
    EXPECT_GT(solid.triangle_count(), 100U);
    EXPECT_EQ(solid.patch_count(), solid.triangle_count());
    EXPECT_EQ(sheet.patch_count(), 2 * sheet.triangle_count());
}

TEST(SolidShells, WallsMayOverlap) {
    Scene scene = empty_scene();
    add_box(scene, {0, 0, 0}, {5, 0.1F, 5});
    add_box(scene, {0, 0, 0}, {0.1F, 3, 5});
    add_box(scene, {2, 0.05F, 2}, {3, 1, 3});  // stands in the floor
    EXPECT_EQ(mark_solid_shells(scene), 36U);
}

TEST(SolidShells, WhatHoldsSomethingIsARoom) {
    Scene chair = empty_scene();
    add_box(chair, {0, 0, 0}, {5, 3, 5});
    add_box(chair, {1, 0.5F, 1}, {2, 1, 2});
    EXPECT_EQ(mark_solid_shells(chair), 12U);
    EXPECT_EQ(solid_triangles(chair, 2), 12U);

    Scene seen = empty_scene();
    add_box(seen, {0, 0, 0}, {5, 3, 5});
    Scene beside = seen;
    Scene lit = seen;
    seen.cameras.emplace_back().eye = {1, 1, 1};
    EXPECT_EQ(mark_solid_shells(seen), 0U);
    beside.cameras.emplace_back().eye = {1, 4, 1};
    EXPECT_EQ(mark_solid_shells(beside), 12U);
    PunctualLight lamp;
    lamp.position = {1, 1, 1};
    lit.punctual_lights.push_back(lamp);
    EXPECT_EQ(mark_solid_shells(lit), 0U);
}

TEST(SolidShells, AreOpaque) {
    for (int i = 0; i < 4; ++i) {
        Scene scene = empty_scene();
        Material& material = scene.materials[0];
        material.alpha_mode = i == 0 ? AlphaMode::mask : AlphaMode::opaque;
        material.metallic = 0.0F;
        material.transmission = i == 1 ? 1.0F : 0.0F;
        material.transmittance = glm::vec3(i == 2 ? 0.5F : 0.0F);
        material.double_sided = i != 3;
        add_box(scene, {0, 0, 0}, {1, 1, 1});
        EXPECT_EQ(mark_solid_shells(scene), 0U) << i;
    }
}

/// Nobody is asked for ever: shells of many triangles, one in the other.
TEST(SolidShells, NestedShellsTakeLimitedTime) {
    Scene scene = empty_scene();
    constexpr int shells = 600;
    for (int i = 0; i < shells; ++i) {
        const float size = 1.0F + 0.01F * static_cast<float>(i);
        add_box(scene, glm::vec3(-size), glm::vec3(size));
    }
    EXPECT_EQ(mark_solid_shells(scene), 12U);  // the innermost one
    EXPECT_EQ(solid_triangles(scene, 1), 12U);
}

/// Glass of 10 mm whose distance of attenuation is its thickness: half of the light is left.
Scene glass_scene() {
    Scene scene = empty_scene();
    Material& glass = scene.materials[0];
    glass.name = "glass";
    glass.base_colour = glm::vec3(1.0F);
    glass.metallic = 0.0F;
    glass.transmission = 1.0F;
    glass.thickness = 0.01F;
    glass.attenuation_distance = 0.01F;
    glass.attenuation_colour = glm::vec3(0.5F);
    return scene;
}

/// Of a box only these two triangles: one of its faces.
void keep_faces(Scene& scene, std::size_t first_triangle, const std::vector<std::size_t>& faces) {
    const std::vector<Triangle> all = scene.triangles;
    scene.triangles.resize(first_triangle);
    for (const std::size_t face : faces) {
        scene.triangles.push_back(all[first_triangle + 2 * face]);
        scene.triangles.push_back(all[first_triangle + 2 * face + 1]);
    }
}

TEST(OpenGlass, SheetsAreThinPanesThatAbsorbAsMuch) {
    Scene scene = glass_scene();
    add_box(scene, {0, 0, 0}, {2, 2, 0.01F});
    keep_faces(scene, 0, {0});
    add_box(scene, {5, 0, 0}, {5.01F, 2, 2});
    keep_faces(scene, 2, {4});
    EXPECT_EQ(thin_open_glass(scene), std::vector<std::string>{"glass"});
    EXPECT_EQ(specular_kind(scene.materials[0]), SpecularKind::pane);
    EXPECT_NEAR(specular_surface(scene.materials[0], glm::vec3(0.8F)).tint.g, 0.4F, 1e-6F);
    EXPECT_TRUE(thin_open_glass(scene).empty());
}

TEST(OpenGlass, WhatClosesStaysABody) {
    Scene scene = glass_scene();
    add_box(scene, {0, 0, 0}, {2, 2, 0.01F});
    EXPECT_TRUE(thin_open_glass(scene).empty());
    keep_faces(scene, 0, {0, 1});  // a pane's two faces without its rims
    EXPECT_TRUE(thin_open_glass(scene).empty());
    // A sheet beside a body of the same material: that stays one.
    scene = glass_scene();
    add_box(scene, {0, 0, 0}, {2, 2, 0.01F});
    add_box(scene, {5, 0, 0}, {5.01F, 2, 2});
    keep_faces(scene, 12, {4});
    EXPECT_TRUE(thin_open_glass(scene).empty());
    EXPECT_EQ(specular_kind(scene.materials[0]), SpecularKind::glass);
}

}  // namespace
}  // namespace raybundle
