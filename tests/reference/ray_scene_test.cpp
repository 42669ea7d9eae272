// SPDX-License-Identifier: Apache-2.0
#include "reference/ray_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/texture_lookup.h"
#include "rooms.h"

namespace raybundle {
namespace {

/// Unit square in the plane y = 0, facing up, uv = (x, z); two triangles.
SceneBuilder textured_square(const Texture& texture, const Material& material) {
    SceneBuilder b;
    b.add_material(glm::vec3(0.5F));
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, 1, 0);
    b.scene.materials[0] = material;
    b.scene.textures.push_back(texture);
    for (std::size_t i = 0; i < b.mesh.positions.size(); ++i) {
        b.mesh.uvs[i] = {b.mesh.positions[i].x, b.mesh.positions[i].z};
    }
    return b;
}

/// What a ray meets that falls straight down on (x, z).
std::optional<SurfacePoint> drop(const RayScene& scene, double x, double z) {
    return scene.trace(scene.from_world({x, 1.0, z}), {0.0, -1.0, 0.0});
}

/// Two texels side by side: white and opaque, mid-grey (sRGB 188 = 0.5 linear) and transparent.
Texture two_texels() {
    Texture t;
    t.width = 2;
    t.height = 1;
    t.repeat_u = false;
    t.repeat_v = false;
    t.rgba = {255, 255, 255, 255, 188, 188, 188, 0};
    return t;
}

TEST(RayScene, RaysWithinAClosedRoomMeetFrontsOnly) {
    const SceneBuilder room = furnace_room(0.5F, 1.0F);
    const RayScene scene(room.scene, room.mesh);
    RandomStream random(1, 0);
    const auto patches = static_cast<std::uint32_t>(room.mesh.patch_count());
    for (std::uint32_t i = 0; i < 200'000; ++i) {
        const SurfacePoint point =
            scene.point_on_patch(i % patches, uniform_triangle(random.next_pair()));
        const glm::dvec3 direction =
            Frame(point.normal).to_world(cosine_hemisphere(random.next_pair()));
        const auto hit = scene.trace_from(point, direction);
        ASSERT_TRUE(hit.has_value()) << i;
        ASSERT_FALSE(hit->absorbs()) << i;
        ASSERT_NE(hit->triangle, point.triangle) << i;
    }
}

TEST(RayScene, OfAFrontAndABackAtOnePlaceTheFrontIsSeen) {
    const TwoRooms rooms = two_rooms(0.5F, 0.0F);
    const RayScene scene(rooms.builder.scene, rooms.builder.mesh);
    RandomStream random(1, 0);
    for (std::uint32_t i = 0; i < 100'000; ++i) {
        const auto patch =
            static_cast<std::uint32_t>(random.next() * static_cast<double>(rooms.first_dark));
        const SurfacePoint point =
            scene.point_on_patch(patch, uniform_triangle(random.next_pair()));
        const auto hit = scene.trace_from(
            point, Frame(point.normal).to_world(cosine_hemisphere(random.next_pair())));
        ASSERT_TRUE(hit.has_value()) << i;
        ASSERT_FALSE(hit->absorbs()) << i;
        ASSERT_LT(hit->patch, rooms.first_dark) << i;
    }
}

TEST(RayScene, BacksAbsorbUnlessDoubleSided) {
    SceneBuilder b;
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, 1, b.add_material(glm::vec3(0.5F)));
    const auto from_below = [&] {
        const RayScene scene(b.scene, b.mesh);
        return scene.trace(scene.from_world({0.3, -1.0, 0.6}), {0.0, 1.0, 0.0});
    };
    auto hit = from_below();
    ASSERT_TRUE(hit.has_value());
    EXPECT_TRUE(hit->absorbs());

    for (std::uint32_t t = 0; t < 2; ++t) {
        b.mesh.back_side[t] = 2 + t;
        b.mesh.side_triangle.push_back(t);
        b.mesh.base_colour.emplace_back(0.25F);
        b.mesh.emission.emplace_back(7.0F);
    }
    hit = from_below();
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->patch, 2 + hit->triangle);
    EXPECT_NEAR(hit->normal.y, -1.0, 1e-6);
    const RayScene scene(b.scene, b.mesh);
    EXPECT_EQ(scene.brdf(*hit).lambert.g, 0.5F);
    EXPECT_NEAR(scene.emission(*hit).g, 7.0, 1e-6);
    EXPECT_NEAR(scene.point_on_patch(3, {0.2, 0.3}).normal.y, -1.0, 1e-6);
}

TEST(RayScene, VisibilityIsSymmetricAndBlockedByBacksToo) {
    SceneBuilder b;
    const auto m = b.add_material(glm::vec3(0.5F));
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, 1, m);        // floor, faces up
    b.add_quad({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 1, 1, m);        // ceiling, faces down
    b.add_quad({0, 0.5F, 0}, {0, 0, 1}, {0.4F, 0, 0}, 1, 1, m);  // faces up, over part of it
    const RayScene scene(b.scene, b.mesh);
    const SurfacePoint covered = scene.point_on_patch(0, {0.6, 0.2});  // x = 0.2, z = 0.8
    const SurfacePoint open = scene.point_on_patch(0, {0.1, 0.8});     // x = 0.8, z = 0.9
    const auto above = [&](double x, double z) {
        return *scene.trace(scene.from_world({x, 0.75, z}), {0.0, 1.0, 0.0});
    };
    for (const double x : {0.1, 0.25}) {
        EXPECT_FALSE(scene.mutually_visible(covered, above(x, 0.8)));
        EXPECT_FALSE(scene.mutually_visible(above(x, 0.8), covered));
    }
    EXPECT_TRUE(scene.mutually_visible(open, above(0.9, 0.8)));
    EXPECT_TRUE(scene.mutually_visible(above(0.9, 0.8), open));
}

TEST(RayScene, TextureIsLookedUpInLinearLightAtTheHit) {
    Material m;
    m.base_colour = glm::vec3(0.8F);
    m.metallic = 0.0F;
    m.specular = 0.0F;
    m.base_colour_texture.texture = 0;
    const SceneBuilder b = textured_square(two_texels(), m);
    const RayScene scene(b.scene, b.mesh);
    // Centres of the texels are at u = 0.25 and 0.75; between them the colour is interpolated.
    constexpr double grey = 0.502886;  // ((188/255 + 0.055)/1.055)^2.4
    const auto lambert = [&](double x, double z) {
        return scene.brdf(*drop(scene, x, z)).lambert.r;
    };
    EXPECT_NEAR(lambert(0.1, 0.5), 0.8, 1e-5);
    EXPECT_NEAR(lambert(0.9, 0.5), 0.8 * grey, 1e-4);
    EXPECT_NEAR(lambert(0.5, 0.3), 0.8 * 0.5 * (1.0 + grey), 1e-4);
}

/// The same texture as the colour of a metal: it is the lobe's.
TEST(RayScene, TextureColoursAMetalsLobe) {
    Material m;
    m.base_colour = glm::vec3(0.8F);
    m.roughness = 0.5F;
    m.base_colour_texture.texture = 0;
    const SceneBuilder b = textured_square(two_texels(), m);
    const RayScene scene(b.scene, b.mesh);
    const Brdf brdf = scene.brdf(*drop(scene, 0.9, 0.5));
    EXPECT_EQ(brdf.lambert, glm::vec3(0.0F));
    EXPECT_NEAR(brdf.f0.r, 0.8 * 0.502886, 1e-4);
    EXPECT_EQ(brdf.lobe.kind, LobeKind::ggx);
    EXPECT_NEAR(brdf.lobe.alpha, 0.25F, 1e-6F);
}

TEST(RayScene, AlphaMaskLetsRaysThrough) {
    Material m;
    m.metallic = 0.0F;
    m.alpha_mode = AlphaMode::mask;
    m.base_colour_texture.texture = 0;
    m.emission = glm::vec3(3.0F);
    SceneBuilder b = textured_square(two_texels(), m);
    b.mesh.emission.assign(2, glm::vec3(3.0F));
    const RayScene scene(b.scene, b.mesh);
    // Alpha falls from 1 to 0 between u = 0.25 and 0.75: cut off at 0.5.
    EXPECT_TRUE(drop(scene, 0.49, 0.3).has_value());
    EXPECT_FALSE(drop(scene, 0.51, 0.3).has_value());
    const SurfacePoint cut = scene.point_on_patch(0, {0.1, 0.8});  // x = 0.8
    EXPECT_EQ(scene.emission(cut), glm::dvec3(0.0));
    const SurfacePoint kept = scene.point_on_patch(0, {0.6, 0.2});  // x = 0.2
    EXPECT_EQ(scene.emission(kept), glm::dvec3(3.0));
}

TEST(RayScene, ShadingNormalsAreInterpolatedOnTheSideThatIsSeen) {
    SceneBuilder b;
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, 1, b.add_material(glm::vec3(0.5F)));
    const glm::vec3 tilted = glm::normalize(glm::vec3(1, 1, 0));
    b.mesh.normals[2] = tilted;  // of the first triangle
    // A non-uniform scale turns normals by its cofactors: (sy sz, sz sx, sx sy).
    b.scene.objects[0].transform.scale = {2, 1, 1};
    const RayScene scene(b.scene, b.mesh);
    const glm::dvec3 corner = scene.shading_normal(scene.point_on_patch(0, {0.0, 1.0}));
    EXPECT_NEAR(corner.x, 1.0 / std::sqrt(5.0), 1e-6);
    EXPECT_NEAR(corner.y, 2.0 / std::sqrt(5.0), 1e-6);
    SurfacePoint below = scene.point_on_patch(0, {0.0, 1.0});
    below.normal = -below.normal;
    EXPECT_NEAR(scene.shading_normal(below).y, -2.0 / std::sqrt(5.0), 1e-6);
    const SurfacePoint flat = scene.point_on_patch(1, {0.3, 0.3});
    EXPECT_EQ(scene.shading_normal(flat), flat.normal);
}

TEST(TextureLookup, WrapsOrClamps) {
    Texture t = two_texels();
    const glm::mat3 identity(1.0F);
    EXPECT_NEAR(look_up(t, identity, {-5.0, 0.5}).w, 1.0, 1e-6);
    EXPECT_NEAR(look_up(t, identity, {5.0, 0.5}).w, 0.0, 1e-6);
    t.repeat_u = true;
    EXPECT_NEAR(look_up(t, identity, {-4.75, 0.5}).w, 1.0, 1e-6);
    EXPECT_NEAR(look_up(t, identity, {1.0, 0.5}).w, 0.5, 1e-6);
    EXPECT_NEAR(look_up(t, identity, {std::nan(""), 0.5}).w, 0.5, 0.5);
}

}  // namespace
}  // namespace raybundle
