// SPDX-License-Identifier: Apache-2.0
// What pictures show in mirrors and through glass.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "oracle/scene_builder.h"
#include "pictures.h"
#include "solution/specular/specular_rays.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::specular_view_test {
namespace {

Material mirror_material() {
    Material material;
    material.base_colour = glm::vec3(1.0F);
    material.metallic = 1.0F;
    material.roughness = 0.0F;
    return material;
}

Material glass_material(float thickness) {
    Material material;
    material.base_colour = glm::vec3(1.0F);
    material.metallic = 0.0F;
    material.roughness = 0.0F;
    material.transmission = 1.0F;
    material.thickness = thickness;
    return material;
}

constexpr glm::uvec2 picture_size(72, 48);

std::vector<glm::vec4> picture_of(const SceneBuilder& builder, const Camera& camera,
                                  int iterations) {
    SolverSettings settings;
    settings.coarse = {256, 400};
    settings.coarse_iterations = 1'000'000;
    Solver solver(builder.scene, builder.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, picture_size);
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < iterations; ++i) {
        solver.step(receivers);
    }
    return image.read_radiance();
}

/// Black things that glow: their picture is known to the last bit.
void add_glowing_things(SceneBuilder& b) {
    const auto glow = [&b](float r, float g, float blue) {
        return b.add_material(glm::vec3(0.0F), {r, g, blue});
    };
    b.add_box({1.0F, 0.2F, 1.0F}, {1.8F, 1.0F, 1.8F}, false, 2, glow(100, 20, 5));
    b.add_box({2.2F, 0.9F, 0.4F}, {2.7F, 1.9F, 2.4F}, false, 2, glow(10, 80, 40));
    b.add_quad({4, 0, 0}, {0, 0, 4}, {0, 3, 0}, 2, 2, glow(5, 10, 60));
    b.add_quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}, 2, 2, glow(30, 30, 30));
}

Camera towards_mirror() {
    Camera camera;
    camera.eye = {3.1F, 1.3F, 3.4F};
    camera.target = {0.0F, 1.4F, 1.9F};
    camera.vertical_fov = 0.9F;
    return camera;
}

/// The wall x = 0 is a mirror: the picture is the one that a camera behind it takes of the scene
/// without it, left and right exchanged.
TEST(SpecularView, AMirrorShowsTheMirroredScene) {
    SceneBuilder with_mirror;
    add_glowing_things(with_mirror);
    with_mirror.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 4}, 3, 3,
                         with_mirror.add_material(mirror_material()));
    SceneBuilder without;
    add_glowing_things(without);
    Camera camera;  // sees nothing but the mirror
    camera.eye = {0.6F, 1.4F, 3.0F};
    camera.target = {0.0F, 1.4F, 2.4F};
    camera.vertical_fov = 0.5F;
    Camera behind = camera;
    behind.eye.x = -behind.eye.x;
    behind.target.x = -behind.target.x;
    const auto seen = picture_of(with_mirror, camera, 0);
    const auto expected = picture_of(without, behind, 0);
    std::size_t lit = 0;
    std::size_t different = 0;
    for (unsigned y = 0; y < picture_size.y; ++y) {
        for (unsigned x = 0; x < picture_size.x; ++x) {
            const glm::vec4& a = seen[y * picture_size.x + x];
            const glm::vec4& b = expected[y * picture_size.x + picture_size.x - 1 - x];
            // The mirror keeps 0.1 % and at grazing angles less.
            const float error = glm::length(glm::vec3(a - b));
            lit += b.g > 0.0F ? 1 : 0;
            different += error > 1.5e-3F * glm::length(glm::vec3(b)) ? 1 : 0;
        }
    }
    EXPECT_GT(lit, picture_size.x * picture_size.y / 3);
    // Pixels whose centre lies on an edge to rounding.
    EXPECT_LE(different, 4U);
}

/// Two mirrors that face each other: the second image is there, too, and darker by their colours.
TEST(SpecularView, MirrorsShowMirrors) {
    SceneBuilder b;
    Material tinted = mirror_material();
    tinted.base_colour = {0.5F, 0.8F, 0.9F};
    const auto mirror = b.add_material(tinted);
    b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 4}, 1, 1, mirror);
    b.add_quad({2, 0, 0}, {0, 0, 4}, {0, 3, 0}, 1, 1, mirror);
    b.add_quad({0, 0, 4}, {0, 3, 0}, {2, 0, 0}, 1, 1,
               b.add_material(glm::vec3(0.0F), glm::vec3(100.0F)));
    // A ray in the plane y = 1.5 that meets x = 0, then x = 2, then the lamp at z = 4.
    const SpecularRays rays(b.scene, b.mesh, std::vector<glm::mat4>{glm::mat4(1.0F)});
    const glm::vec3 eye(1.0F, 1.5F, 0.5F);
    const glm::vec3 direction = glm::normalize(glm::vec3(-1.0F, 0.0F, 0.8F));
    std::array<ContinuedRay, SpecularRays::most_ends> ends;
    ASSERT_EQ(rays.follow(eye, direction, 1, ends), 1U);
    // z grows by 0.8 for each metre along x: 4 is reached 4.375 m on, 1.375 m before x = 2.
    EXPECT_NEAR(ends[0].position.z, 4.0F, 1e-4F);
    EXPECT_NEAR(ends[0].position.x, 2.0F - 1.375F, 1e-4F);
    const float cosine = -direction.x;
    const float p = std::pow(1.0F - std::abs(cosine), 5.0F);
    for (int c = 0; c < 3; ++c) {
        const float f = tinted.base_colour[c] + (1.0F - tinted.base_colour[c]) * p;
        EXPECT_NEAR(std::abs(ends[0].throughput[c]), f * f, 2e-4F);
    }
}

/// What a viewer has hidden is in no mirror either; a mirror that is hidden reflects nothing.
TEST(SpecularView, MirrorsDoNotShowWhatIsHidden) {
    SceneBuilder b;
    b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 4}, 1, 1, b.add_material(mirror_material()));
    const auto glow = b.add_material(glm::vec3(0.0F), glm::vec3(1.0F));
    const std::uint32_t board = b.add_object("board");
    b.add_quad({1, 0, 0}, {0, 0, 4}, {0, 3, 0}, 1, 1, glow);
    b.add_object("wall");
    b.add_quad({2, 0, 0}, {0, 0, 4}, {0, 3, 0}, 1, 1, glow);
    const std::vector<glm::mat4> places(3, glm::mat4(1.0F));
    const SpecularRays rays(b.scene, b.mesh, places);
    std::array<ContinuedRay, SpecularRays::most_ends> ends;
    const auto ends_without = [&](const std::vector<std::uint32_t>& hidden) {
        return rays.follow({0.5F, 1.5F, 2.0F}, {-1, 0, 0}, 1, ends, SpecularRays::Coats::followed,
                           hidden);
    };
    ASSERT_EQ(ends_without({}), 1U);
    EXPECT_NEAR(ends[0].position.x, 1.0F, 1e-4F);
    ASSERT_EQ(ends_without({board}), 1U);
    EXPECT_NEAR(ends[0].position.x, 2.0F, 1e-4F);
    ASSERT_EQ(ends_without({1, 2}), 1U);
    EXPECT_EQ(ends[0].surface, ContinuedRay::sky);
    EXPECT_EQ(ends_without({0}), 0U) << "the mirror itself";
}

/// A slab of absorbing glass, 1 m thick: Snell shifts the ray, Fresnel takes a share at both faces,
/// Beer and Lambert inside.
TEST(SpecularView, ASlabOfGlassShiftsAndAbsorbs) {
    SceneBuilder b;
    Material material = glass_material(1.0F);
    material.attenuation_distance = 1.0F;
    material.attenuation_colour = {0.8F, 0.5F, 0.1F};
    b.add_box({-9, -9, 2}, {9, 9, 3}, false, 1, b.add_material(material));
    const SpecularRays rays(b.scene, b.mesh, std::vector<glm::mat4>{glm::mat4(1.0F)});
    for (const float degrees : {0.0F, 20.0F, 50.0F}) {
        const float angle = glm::radians(degrees);
        const glm::vec3 direction(std::sin(angle), 0.0F, std::cos(angle));
        std::array<ContinuedRay, SpecularRays::most_ends> ends;
        const std::size_t count = rays.follow(glm::vec3(0.1F, 0.2F, 0.0F), direction, 1, ends);
        ASSERT_GE(count, 2U);
        const float inside = std::asin(std::sin(angle) / 1.5F);
        const float f = fresnel_reflectance(std::cos(angle), 1.5F);
        for (int c = 0; c < 3; ++c) {
            const float left = std::pow(material.attenuation_colour[c], 1.0F / std::cos(inside));
            EXPECT_NEAR(ends[0].throughput[c], (1.0F - f) * (1.0F - f) * left, 1e-4F) << degrees;
        }
        // It leaves as parallel as it came, where Snell has taken it.
        EXPECT_NEAR(glm::length(ends[0].towards + direction), 0.0F, 1e-5F);
        EXPECT_NEAR(ends[0].position.x, 0.1F + 2.0F * std::tan(angle) + std::tan(inside), 1e-4F);
        EXPECT_NEAR(ends[0].position.z, 3.0F, 1e-4F);
        // All ends together carry no more than what came in.
        float sum = 0.0F;
        for (std::size_t i = 0; i < count; ++i) {
            sum += ends[i].throughput.r;
        }
        EXPECT_LE(sum, 1.0F);
    }
}

/// A smooth coat on the floor z = 0 below a sky: a ray that meets it first gets what it reflects
/// besides; one that comes by a mirror sees the surface below it as well.
TEST(SpecularView, ACoatAddsWhatItReflects) {
    SceneBuilder b;
    Material lacquer;
    lacquer.metallic = lacquer.specular = 0.0F;
    lacquer.clear_coat = 0.5F;
    b.add_quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 1, 1, b.add_material(lacquer));
    Material mirror = mirror_material();
    mirror.double_sided = true;
    b.add_quad({4, -9, 0.5F}, {0, 18, 0}, {0, 0, 9}, 1, 1, b.add_material(mirror));
    const SpecularRays rays(b.scene, b.mesh, std::vector<glm::mat4>{glm::mat4(1.0F)});
    std::array<ContinuedRay, SpecularRays::most_ends> ends;
    const glm::vec3 down = glm::normalize(glm::vec3(-1.0F, 0.0F, -1.0F));
    const float share = 0.5F * (0.04F + 0.96F * std::pow(1.0F + down.z, 5.0F));
    ASSERT_EQ(rays.follow({0, 0, 1}, down, 1, ends), 1U);
    EXPECT_TRUE(ends[0].added);
    EXPECT_EQ(ends[0].surface, ContinuedRay::sky);
    EXPECT_NEAR(ends[0].throughput.g, share, 1e-5F);
    EXPECT_EQ(rays.follow({0, 0, 1}, down, 1, ends, SpecularRays::Coats::passed), 0U);
    // Towards the mirror x = 4 at z = 1, and from there down to the floor at x = 3.
    ASSERT_EQ(rays.follow({3, 0, 2}, {-down.x, 0, down.z}, 1, ends), 2U);
    EXPECT_FALSE(ends[0].added);
    EXPECT_NEAR(ends[0].position.z, 0.0F, 1e-4F);
    EXPECT_NEAR(ends[0].position.x, 3.0F, 1e-3F);
    EXPECT_NEAR(ends[1].throughput.g / ends[0].throughput.g, share, 1e-4F);
    EXPECT_EQ(rays.boxes().size(), 1U);
    EXPECT_LT(rays.boxes()[0].min.x, -8.0F);
    EXPECT_GT(rays.boxes(SpecularRays::Coats::passed)[0].min.x, 3.0F);
}

/// Where glass splits a ray more often than there is room for ends, chance decides: the mean over
/// many rays is what all ends would bring.
TEST(SpecularView, RaysThroughManyPanesKeepTheirLight) {
    SceneBuilder b;
    const auto pane = b.add_material(glass_material(0.0F));
    const auto far = b.add_material(glm::vec3(0.0F), glm::vec3(1.0F));
    constexpr int panes = 5;
    for (int i = 0; i < panes; ++i) {
        b.add_quad({-9, -9, static_cast<float>(i)}, {0, 18, 0}, {18, 0, 0}, 1, 1, pane);
    }
    b.add_quad({-9, -9, 9}, {0, 18, 0}, {18, 0, 0}, 1, 1, far);
    const SpecularRays rays(b.scene, b.mesh, std::vector<glm::mat4>{glm::mat4(1.0F)});
    double sum = 0.0;
    constexpr std::uint32_t count = 4096;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        std::array<ContinuedRay, SpecularRays::most_ends> ends;
        const std::size_t found = rays.follow({0, 0, -1}, {0, 0, 1}, seed, ends);
        for (std::size_t i = 0; i < found; ++i) {
            sum += ends[i].surface == ContinuedRay::sky ? 0.0
                                                        : static_cast<double>(ends[i].throughput.g);
        }
    }
    // m plates of 2 surfaces each transmit (1 - R)/(1 + (2m - 1) R) (Stokes 1862).
    const double exact = (1.0 - 0.04) / (1.0 + (2.0 * panes - 1.0) * 0.04);
    // Rays of less than 1/512 are dropped.
    EXPECT_NEAR(sum / count, exact, 0.02 * exact);
}

/// A room with a lamp and a box, and whatever stands before its wall x = 0.
SceneBuilder lit_room_with(const Material& material) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 8, b.add_material({0.6F, 0.55F, 0.5F}));
    b.add_box({2.2F, 0.0F, 0.8F}, {3.0F, 1.2F, 1.6F}, false, 4, b.add_material({0.7F, 0.2F, 0.1F}));
    b.add_quad({1.5F, 2.98F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 2, 2,
               b.add_material(glm::vec3(0.0F), glm::vec3(500.0F)));
    b.add_quad({0.02F, 0.4F, 0.6F}, {0, 2.2F, 0}, {0, 0, 2.8F}, 6, 6, b.add_material(material));
    return b;
}

/// Means over blocks of pixels, relative RMS.
double difference_from_paths(const SceneBuilder& room, int iterations, std::uint32_t paths) {
    const auto truth =
        path_traced_centres(room.scene, room.mesh, towards_mirror(), picture_size, paths);
    const auto picture = picture_of(room, towards_mirror(), iterations);
    return block_difference(picture, truth, picture_size, 6);
}

/// Most of the light that is seen is the lamp's image, which the path tracer would blur were its
/// mirror not as ideal.
TEST(HeavySpecularView, ARoomWithAMirrorAgreesWithPathTracing) {
    EXPECT_LT(difference_from_paths(lit_room_with(mirror_material()), 1024, 2048), 0.015);
}

TEST(HeavySpecularView, ARoomWithAPaneAgreesWithPathTracing) {
    EXPECT_LT(difference_from_paths(lit_room_with(glass_material(0.0F)), 1024, 512), 0.03);
}

/// An object moves: what is seen of it in the mirror follows, and the picture becomes that of the
/// scene that has it there from the beginning.
TEST(SpecularView, AMoveIsSeenInTheMirror) {
    const auto scene_with = [](float z, SceneBuilder& b) {
        add_glowing_things(b);
        b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 4}, 3, 3, b.add_material(mirror_material()));
        Transform transform;
        transform.translation = {0.0F, 0.0F, z};
        const auto object = b.add_object("cube", transform);
        b.add_box({0.5F, 0.3F, 0.0F}, {0.9F, 0.7F, 0.4F}, false, 2,
                  b.add_material(glm::vec3(0.0F), {50.0F, 60.0F, 1.0F}));
        return object;
    };
    SceneBuilder moved;
    const std::uint32_t object = scene_with(2.0F, moved);
    SolverSettings settings;
    settings.coarse = {128, 200};
    Solver solver(moved.scene, moved.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, picture_size);
    image.set_camera(towards_mirror());
    BundleReceiver* const receivers[] = {&image};
    const auto before = image.read_radiance();
    solver.move_object(object, glm::translate(glm::mat4(1.0F), {0.0F, 0.0F, 2.7F}), receivers);
    while (solver.correcting()) {
        solver.step(receivers);
    }
    const auto after = image.read_radiance();
    SceneBuilder there;
    scene_with(2.7F, there);
    const auto expected = picture_of(there, towards_mirror(), 0);
    std::size_t changed = 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        const float size = glm::length(glm::vec3(expected[i]));
        changed += glm::length(glm::vec3(before[i] - after[i])) > 0.1F * size ? 1 : 0;
        different += glm::length(glm::vec3(expected[i] - after[i])) > 1e-3F * size ? 1 : 0;
    }
    EXPECT_GT(changed, 20U);
    EXPECT_LE(different, 4U);
}

/// Equal seeds, equal bits, also where chance decides which way a ray takes.
TEST(SpecularView, PicturesStayTheSameToTheBit) {
    const SceneBuilder room = lit_room_with(glass_material(0.0F));
    EXPECT_EQ(picture_of(room, towards_mirror(), 16), picture_of(room, towards_mirror(), 16));
}

/// Error that a picture of a room states, of a lamp on the wall opposite. pane: between it and the
/// eye.
ImageStatistics stated_error(bool pane) {
    SceneBuilder b;
    const auto paint = b.add_material(glm::vec3(0.5F));
    const auto lamp = b.add_material(glm::vec3(0.5F), glm::vec3(1000.0F));
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 8, paint);
    b.add_quad({1.4F, 1.1F, 3.95F}, {0, 0.8F, 0}, {1.2F, 0, 0}, 2, 2, lamp);
    if (pane) {
        b.add_quad({1.0F, 0.5F, 2.0F}, {0, 2, 0}, {2, 0, 0}, 1, 1,
                   b.add_material(glass_material(0.0F)));
    }
    SolverSettings settings;
    settings.coarse = {128, 200};
    Solver solver(b.scene, b.mesh, settings);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, picture_size);
    Camera camera;
    camera.eye = {2.0F, 1.5F, 0.3F};
    camera.target = {2.0F, 1.5F, 4.0F};
    camera.vertical_fov = 0.9F;
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 128; ++i) {
        solver.step(receivers);
    }
    image.request_statistics();
    image.finish_statistics();
    return image.statistics();
}

/// The lamp is brighter than anything else: in the denominator it would make all errors small.
TEST(SpecularView, ALampBehindAPaneCountsForTheErrorAsMuchAsOneInFrontOfIt) {
    const ImageStatistics direct = stated_error(false);
    const ImageStatistics behind = stated_error(true);
    ASSERT_TRUE(direct.known && behind.known);
    EXPECT_NEAR(behind.noise / direct.noise, 1.0, 0.4);
    EXPECT_NEAR(behind.discretisation / direct.discretisation, 1.0, 0.25);
    EXPECT_NEAR(behind.rms_luminance / direct.rms_luminance, 1.0, 0.1);
}

}  // namespace
}  // namespace raybundle::specular_view_test
