// SPDX-License-Identifier: Apache-2.0
// Methods against each other where light arrives by a glossy floor. Bounds in standard errors are
// 4.5: passed by chance once in 150 000 for means of many paths, and 6.5 for standard errors of 15
// degrees of freedom: once in 100 000.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "research/reference_method.h"
#include "research/single_ray.h"
#include "rooms.h"

namespace raybundle {
namespace {

constexpr double sigmas_of_batches = 6.5;

class GlossyRoom : public testing::TestWithParam<std::size_t> {
  protected:
    static NamedMaterial material() { return glossy_materials()[GetParam()]; }
};

TEST_P(GlossyRoom, WallSeesNoLamp) {
    const ScreenedLamp s = screened_lamp(material().material, glm::vec3(0.5F));
    PathSettings direct;
    direct.max_bounces = 1;
    const Tracing t(s.builder, direct);
    EXPECT_EQ(mean_irradiance(t.scene, t.tracer, s.wall, s.wall + s.wall_patches, 50'000).largest,
              0.0);
}

TEST_P(GlossyRoom, NextEventEstimationChangesNothingButTheNoise) {
    const ScreenedLamp s = screened_lamp(material().material, glm::vec3(0.5F));
    PathSettings settings;
    settings.next_event = false;
    const Tracing both(s.builder);
    const Tracing one(s.builder, settings);
    const std::uint32_t last = s.wall + s.wall_patches;
    const Estimate a = mean_irradiance(both.scene, both.tracer, s.wall, last, 300'000, 1);
    const Estimate c = mean_irradiance(one.scene, one.tracer, s.wall, last, 1'600'000, 2);
    EXPECT_NEAR(a.mean, c.mean, sigmas * std::hypot(a.standard_error, c.standard_error));
    EXPECT_LT(a.standard_error, 0.01 * a.mean);
    EXPECT_LT(c.standard_error, 0.02 * c.mean);
}

/// What the lamp sends to the wall, the wall would send to the lamp: flux received per radiance
/// emitted is the same when they change places (Helmholtz), both black.
TEST_P(GlossyRoom, ExchangeOfFluxIsReciprocal) {
    ScreenedLamp s = screened_lamp(material().material, glm::vec3(0.0F));
    const auto received = [&](std::uint32_t first, std::uint32_t count, std::uint64_t seed) {
        const Tracing t(s.builder);
        Estimate e = mean_irradiance(t.scene, t.tracer, first, first + count, 600'000, seed);
        double area = 0.0;
        for (std::uint32_t patch = first; patch < first + count; ++patch) {
            area += t.scene.patch_area(patch);
        }
        e.mean *= area;
        e.standard_error *= area;
        return e;
    };
    const Estimate there = received(s.wall, s.wall_patches, 1);
    const std::uint32_t wall_material = s.builder.mesh.triangle_material[s.wall];
    const std::uint32_t lamp_material = s.builder.mesh.triangle_material[s.lamp];
    for (std::uint32_t i = 0; i < s.wall_patches; ++i) {
        s.builder.set_triangle_material(s.wall + i, lamp_material);
    }
    for (std::uint32_t i = 0; i < 2; ++i) {
        s.builder.set_triangle_material(s.lamp + i, wall_material);
    }
    const Estimate back = received(s.lamp, 2, 2);
    EXPECT_NEAR(there.mean, back.mean,
                sigmas * std::hypot(there.standard_error, back.standard_error));
    EXPECT_LT(there.standard_error, 0.01 * there.mean);
    EXPECT_LT(back.standard_error, 0.01 * back.mean);
}

/// Particles that walk by the BRDF light every patch as paths do.
TEST_P(GlossyRoom, SingleRayAgreesWithPathTracing) {
    const ScreenedLamp s = screened_lamp(material().material, glm::vec3(0.5F));
    const Tracing t(s.builder);
    SingleRay particles(t.scene, t.lights, 3);
    for (int i = 0; i < 96; ++i) {
        particles.iterate();
    }
    for (std::uint32_t patch = s.wall; patch < s.floor; ++patch) {
        const Estimate path =
            mean_irradiance(t.scene, t.tracer, patch, patch + 1, 40'000, 1'000 + patch);
        const double error = std::hypot(path.standard_error, particles.standard_error(patch).g);
        EXPECT_NEAR(particles.irradiance(patch).g, path.mean, sigmas_of_batches * error) << patch;
        EXPECT_LT(error, 0.05 * path.mean) << patch;
    }
}

class GlossyPicture : public GlossyRoom {};

/// The picture of a single-ray solution, main part and random representation, shows the floor as
/// path tracing does: 3 % for its mean. Pixels differ by noise, most where the lobe is sharp.
TEST_P(GlossyPicture, SingleRayPictureAgreesWithPathTracing) {
    SceneBuilder b = enclosure(0.5F);
    const auto floor = add_material(b, material().material);
    const auto black = b.add_material(glm::vec3(0.0F));
    // 9 m² of fine patches a hand above the floor, and the floor itself black.
    for (std::size_t i = 0; i < b.mesh.triangle_count(); ++i) {
        if (b.cell_centre(i).y < 0.01F) {
            b.set_triangle_material(i, black);
        }
    }
    b.add_quad({0.5F, 0.1F, 0.5F}, {0, 0, 3}, {3, 0, 0}, 24, 24, floor);
    const RayScene scene(b.scene, b.mesh);
    Camera camera;
    camera.eye = glm::vec3(odd_rotation() * glm::vec4(2.0F, 1.6F, 3.8F, 1.0F));
    camera.target = glm::vec3(odd_rotation() * glm::vec4(1.8F, 0.1F, 2.0F, 1.0F));
    camera.vertical_fov = 0.5F;
    constexpr std::size_t width = 16;
    const auto render = [&](ReferenceKind kind, int iterations) {
        const auto method = make_reference_method(kind, scene, camera, {width, width}, 1);
        for (int i = 0; i < iterations; ++i) {
            method->iterate();
        }
        return method->picture();
    };
    const auto path = render(ReferenceKind::path, 384);
    const auto single = render(ReferenceKind::single_ray, 200);  // not a multiple of a look's
    double mean = 0.0;
    double difference = 0.0;
    double squares = 0.0;
    double misses = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        mean += path[i].g;
        difference += single[i].g - path[i].g;
        squares += path[i].g * path[i].g;
        misses += std::pow(single[i].g - path[i].g, 2);
    }
    EXPECT_LT(std::abs(difference), 0.03 * mean);
    EXPECT_LT(std::sqrt(misses / squares), 0.3);
}

std::string material_name(const testing::TestParamInfo<std::size_t>& test) {
    return glossy_materials()[test.param].name;
}

INSTANTIATE_TEST_SUITE_P(Materials, GlossyRoom, testing::Range(std::size_t{0}, std::size_t{3}),
                         material_name);
INSTANTIATE_TEST_SUITE_P(Materials, GlossyPicture, testing::Values(std::size_t{0}), material_name);
INSTANTIATE_TEST_SUITE_P(HeavyMaterials, GlossyPicture,
                         testing::Range(std::size_t{1}, std::size_t{3}), material_name);

}  // namespace
}  // namespace raybundle
