// SPDX-License-Identifier: Apache-2.0
// Single-ray transport against closed forms and against path tracing. Batch means give 15 degrees
// of freedom: a deviation of 6.5 standard errors is passed by chance once in 100 000.
#include "research/single_ray.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "rooms.h"

namespace raybundle {
namespace {

using std::numbers::pi;
constexpr double particle_sigmas = 6.5;

struct Particles {
    explicit Particles(const SceneBuilder& builder, std::uint64_t seed = 1)
        : tracing(builder), solution(tracing.scene, tracing.lights, seed) {}

    void run(int iterations, int threads = 2) {
        tbb::task_arena arena(threads);
        arena.execute([&] {
            for (int i = 0; i < iterations; ++i) {
                solution.iterate();
            }
        });
    }

    /// Area mean over patches [first, last) with its standard error, green channel.
    [[nodiscard]] Estimate mean(std::uint32_t first, std::uint32_t last) const {
        double area = 0.0;
        std::vector<double> means(SingleRay::batches, 0.0);
        for (std::uint32_t patch = first; patch < last; ++patch) {
            const double a = tracing.scene.patch_area(patch);
            area += a;
            for (std::uint32_t b = 0; b < SingleRay::batches; ++b) {
                means[b] += a * solution.batch_irradiance(patch, b).g;
            }
        }
        Estimate result;
        for (double& m : means) {
            m /= area;
            result.mean += m / SingleRay::batches;
        }
        double scatter = 0.0;
        for (const double m : means) {
            scatter += (m - result.mean) * (m - result.mean);
        }
        result.standard_error =
            std::sqrt(scatter / (SingleRay::batches * (SingleRay::batches - 1.0)));
        return result;
    }

    Tracing tracing;
    SingleRay solution;
};

std::uint32_t patch_count(const SceneBuilder& builder) {
    return static_cast<std::uint32_t>(builder.mesh.patch_count());
}

void expect_estimate(const Estimate& estimate, double exact, double relative_error) {
    EXPECT_NEAR(estimate.mean, exact, particle_sigmas * estimate.standard_error + 1e-9 * exact);
    EXPECT_LT(estimate.standard_error, relative_error * exact);
}

class SingleRayFurnace : public testing::TestWithParam<float> {};

/// Every patch of an isothermal enclosure receives pi Le/(1 - albedo), and the standard errors say
/// how far it is off: squared deviations in their unit have the mean 15/13 of a t distribution.
TEST_P(SingleRayFurnace, HasTheSameIrradianceEverywhere) {
    const SceneBuilder room = furnace_room(GetParam(), 100.0F);
    Particles p(room);
    p.run(24);
    const double exact = pi * 100.0 / (1.0 - static_cast<double>(GetParam()));
    expect_estimate(p.mean(0, patch_count(room)), exact, 0.005);
    double squares = 0.0;
    for (std::uint32_t patch = 0; patch < patch_count(room); ++patch) {
        const double deviation = p.solution.irradiance(patch).g - exact;
        const double error = p.solution.standard_error(patch).g;
        EXPECT_LT(std::abs(deviation), particle_sigmas * error);
        squares += deviation * deviation / (error * error);
    }
    // 80 patches: the standard deviation of this mean is 0.22.
    EXPECT_NEAR(squares / patch_count(room), 15.0 / 13.0, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Albedos, SingleRayFurnace, testing::Values(0.0F, 0.5F, 0.9F));

TEST(SingleRay, EnclosureHasTheMeanIrradianceOfItsFluxBalance) {
    for (const float albedo : {0.5F, 0.95F}) {
        const SceneBuilder room = enclosure(albedo);
        Particles p(room);
        p.run(24);
        const double exact =
            enclosure_flux / (enclosure_surface * (1.0 - static_cast<double>(albedo)));
        expect_estimate(p.mean(0, patch_count(room)), exact, 0.005);
    }
}

TEST(SingleRay, CubeHasItsFormFactors) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto black = b.add_material(glm::vec3(0.0F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1.0F));
    b.add_box({0, 0, 0}, {1, 1, 1}, true, 2, black);
    const std::uint32_t face = patch_count(b) / 6;  // faces: x0, x1, y0, y1, z0, z1
    for (std::uint32_t i = 4 * face; i < 5 * face; ++i) {
        b.set_triangle_material(i, lamp);
    }
    Particles p(b);
    p.run(24);
    expect_estimate(p.mean(5 * face, 6 * face), 0.199825 * pi, 0.005);
    expect_estimate(p.mean(0, 4 * face), 0.200044 * pi, 0.005);
}

/// A regular polygon of 256 sides and the area of the disc, facing up or down.
void add_disc(SceneBuilder& b, double radius, float y, bool up, std::uint32_t material) {
    constexpr int sides = 256;
    const double step = 2.0 * pi / sides;
    const double rim = radius * std::sqrt(step / std::sin(step));
    const auto corner = [&](int i) {
        return glm::vec3(rim * std::cos(step * i), y, rim * std::sin(step * i));
    };
    for (int i = 0; i < sides; ++i) {
        b.add_triangle({0, y, 0}, corner(up ? i + 1 : i), corner(up ? i : i + 1), material);
    }
}

/// Coaxial discs (Howell, catalogue of configuration factors, C-41).
TEST(SingleRay, DiscsHaveTheirFormFactor) {
    constexpr double lamp_radius = 0.3;
    constexpr double radius = 0.8;
    constexpr double distance = 0.7;
    SceneBuilder b;
    b.set_transform(odd_rotation());
    add_disc(b, lamp_radius, static_cast<float>(distance), false,
             b.add_material(glm::vec3(0.0F), glm::vec3(1.0F)));
    const std::uint32_t first = patch_count(b);
    add_disc(b, radius, 0.0F, true, b.add_material(glm::vec3(0.0F)));
    Particles p(b);
    p.run(24);
    const double r1 = radius / distance;
    const double r2 = lamp_radius / distance;
    const double x = 1.0 + (1.0 + r2 * r2) / (r1 * r1);
    const double factor = 0.5 * (x - std::sqrt(x * x - 4.0 * r2 * r2 / (r1 * r1)));
    expect_estimate(p.mean(first, patch_count(b)), pi * factor, 0.001);
}

TEST(SingleRay, DarkRoomBehindAWallWithoutThicknessStaysExactlyDark) {
    for (const float thickness : {0.0F, 1e-6F, 1e-3F}) {
        const TwoRooms rooms = two_rooms(0.8F, thickness);
        Particles p(rooms.builder);
        p.run(24);
        EXPECT_EQ(p.mean(rooms.first_dark, patch_count(rooms.builder)).mean, 0.0) << thickness;
        expect_estimate(p.mean(0, rooms.first_dark), enclosure_flux / (enclosure_surface * 0.2),
                        0.005);
    }
}

/// A lamp a million times dimmer than the one in the next room is not starved.
TEST(SingleRay, DimLampIsNotStarvedByABrightOne) {
    TwoRooms rooms = two_rooms(0.8F, 0.1F);
    SceneBuilder& b = rooms.builder;
    const auto bright = static_cast<double>(enclosure_flux / pi);
    const auto dim = b.add_material(glm::vec3(0.8F), glm::vec3(static_cast<float>(1e-6 * bright)));
    double area = 0.0;
    const Tracing areas(b);
    for (std::uint32_t i = rooms.first_dark; i < patch_count(b); ++i) {
        const glm::vec3 c = b.cell_centre(i);
        if (c.y > 3.99F && c.x > 5.0F && c.x < 6.0F && c.z > 1.0F && c.z < 2.0F) {
            b.set_triangle_material(i, dim);
            area += areas.scene.patch_area(i) * areas.scene.square_metres();
        }
    }
    ASSERT_GT(area, 0.5);
    Particles p(b);
    p.run(24);
    const double flux = pi * 1e-6 * bright * area;
    expect_estimate(p.mean(rooms.first_dark, patch_count(b)), flux / (enclosure_surface * 0.2),
                    0.01);
}

TEST(SingleRay, OpenFloorReceivesTheSky) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 2, 2, b.add_material(glm::vec3(0.5F)));
    b.scene.sky_radiance = glm::vec3(100.0F);
    Particles p(b);
    p.run(24);
    expect_estimate(p.mean(0, patch_count(b)), 100.0 * pi, 0.005);
}

TEST(SingleRay, SameSeedGivesTheSameBitsWithAnyNumberOfThreads) {
    const SceneBuilder room = enclosure(0.8F);
    Particles one(room, 5);
    Particles two(room, 5);
    Particles other(room, 6);
    one.run(3, 1);
    two.run(3, 2);
    other.run(3, 2);
    int same_as_other = 0;
    for (std::uint32_t patch = 0; patch < patch_count(room); ++patch) {
        const auto bits = [&](const Particles& p) {
            return std::bit_cast<std::uint64_t>(p.solution.irradiance(patch).g);
        };
        EXPECT_EQ(bits(one), bits(two));
        same_as_other += bits(one) == bits(other) ? 1 : 0;
    }
    // All particles carry the same power: by chance a patch may be hit as often.
    EXPECT_LT(same_as_other, static_cast<int>(patch_count(room)) / 4);
    EXPECT_EQ(one.solution.rays(), two.solution.rays());
}

TEST(SingleRay, WithoutLightEverythingIsDark) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {1, 1, 1}, true, 1, b.add_material(glm::vec3(0.5F)));
    Particles p(b);
    p.run(1);
    EXPECT_EQ(p.mean(0, patch_count(b)).mean, 0.0);
}

/// A furnished room, coloured, with sky and a lamp that is partly hidden: patch by patch.
TEST(SingleRay, AgreesWithPathTracing) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto wall = b.add_material(glm::vec3(0.6F, 0.7F, 0.5F));
    const auto lamp = b.add_material(glm::vec3(0.4F), glm::vec3(60.0F, 50.0F, 40.0F));
    b.add_quad({0, 0, 0}, {0, 0, 3}, {2, 0, 0}, 2, 2, wall);         // floor
    b.add_quad({0, 2, 0}, {2, 0, 0}, {0, 0, 3}, 2, 2, wall);         // ceiling
    b.add_quad({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 2, 2, wall);         // back
    b.add_quad({0, 0, 0}, {0, 2, 0}, {0, 0, 3}, 2, 2, wall);         // left; right, front open
    b.add_box({0.5F, 0, 0.6F}, {1.2F, 0.8F, 1.3F}, false, 1, wall);  // stands on the floor
    b.add_quad({0.4F, 1.6F, 0.4F}, {0.6F, 0, 0}, {0, 0, 0.6F}, 1, 1, lamp);  // faces down
    b.scene.sky_radiance = glm::vec3(20.0F);
    Particles p(b);
    p.run(64);
    double squares = 0.0;
    int compared = 0;
    for (std::uint32_t patch = 0; patch < patch_count(b); ++patch) {
        const Estimate path =
            mean_irradiance(p.tracing.scene, p.tracing.tracer, patch, patch + 1, 10'000, patch);
        const double particles = p.solution.irradiance(patch).g;
        const double error = std::hypot(path.standard_error, p.solution.standard_error(patch).g);
        EXPECT_NEAR(particles, path.mean, particle_sigmas * error) << patch;
        EXPECT_LT(error, 0.1 * path.mean + 0.05) << patch;
        if (error > 0.0) {
            squares += std::pow((particles - path.mean) / error, 2);
            ++compared;
        }
    }
    // About chi-square: standard deviation of the mean sqrt(2/46) = 0.21.
    EXPECT_LT(squares / compared, 2.1);
    EXPECT_GT(compared, 40);
}

}  // namespace
}  // namespace raybundle
