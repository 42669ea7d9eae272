// SPDX-License-Identifier: Apache-2.0
// Reflection by the BRDFs of scene/material/brdf.h against quadratures that share nothing with it
// but f_r. Bounds in standard errors are 4.5: passed by chance once in 150 000.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <vector>

#include "hemisphere_quadrature.h"
#include "reference/ray_caster.h"
#include "rooms.h"

namespace raybundle {
namespace {

using std::numbers::pi;

Estimate estimate(std::uint32_t count, const std::function<double(PixelSampler&)>& sample) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        PixelSampler sampler(1, i, 0, 0);
        const double value = sample(sampler);
        sum += value;
        squares += value * value;
    }
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / (count - 1.0)), 0.0};
}

void expect_estimate(const Estimate& e, double exact, double relative_error) {
    EXPECT_NEAR(e.mean, exact, sigmas * e.standard_error + 1e-4 * exact);
    EXPECT_LT(e.standard_error, relative_error * exact);
}

/// Under a uniform sky of radiance L a floor shows a(cos) L, a by quadrature, whatever finds the
/// light: light and BRDF sampling, either alone.
TEST(GlossyFloor, ReflectsItsAlbedoOfAUniformSky) {
    PathSettings alone;
    alone.next_event = false;
    for (const NamedMaterial& named : glossy_materials()) {
        SceneBuilder b;
        b.set_transform(odd_rotation());
        b.add_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 1, 1, add_material(b, named.material));
        b.scene.sky_radiance = glm::vec3(100.0F);
        const Tracing both(b);
        const Tracing one(b, alone);
        const Tracing several(b, {.first_light_samples = 3});
        const RayCaster caster(both.scene, both.lights);
        const Brdf brdf = make_brdf(named.material, named.material.base_colour);
        for (const float cosine : {0.95F, 0.4F, 0.1F}) {
            const double exact = 100.0 * test::albedo_by_quadrature(brdf, cosine).g;
            const glm::vec3 up = test::direction_in_plane(cosine);
            const glm::dvec3 away(odd_rotation() * glm::vec4(up.x, up.z, up.y, 0.0F));
            const glm::dvec3 eye = 0.2 * away;  // own space; the floor's centre is the origin
            SCOPED_TRACE(testing::Message() << named.name << " " << cosine);
            expect_estimate(
                estimate(50'000,
                         [&](PixelSampler& s) { return both.tracer.radiance(eye, -away, s).g; }),
                exact, 0.005);
            expect_estimate(
                estimate(50'000,
                         [&](PixelSampler& s) { return one.tracer.radiance(eye, -away, s).g; }),
                exact, 0.005);
            expect_estimate(
                estimate(50'000,
                         [&](PixelSampler& s) { return several.tracer.radiance(eye, -away, s).g; }),
                exact, 0.005);
            expect_estimate(
                estimate(50'000, [&](PixelSampler& s) { return caster.radiance(eye, -away, s).g; }),
                exact, 0.005);
        }
    }
}

/// Irradiance in a sphere that emits Le = 1 everywhere. Both ends of a chord make the same angle
/// with the normal, so radiance is a function of one cosine: L(c) = 1 + integral of K(c, c') L(c')
/// dc', K = c' times the mean of f_r over azimuths times 2 pi; and E = 2 pi integral of L c dc.
double sphere_irradiance(const Brdf& brdf) {
    constexpr int cosines = 96;
    constexpr int azimuths = 256;
    const auto cosine = [](int i) { return (i + 0.5) / cosines; };
    std::vector<double> kernel(std::size_t{cosines} * cosines);
    for (int i = 0; i < cosines; ++i) {
        const glm::vec3 out = test::direction_in_plane(static_cast<float>(cosine(i)));
        for (int j = 0; j < cosines; ++j) {
            const double sine = std::sqrt(1.0 - cosine(j) * cosine(j));
            double sum = 0.0;
            for (int k = 0; k < azimuths; ++k) {
                const double phi = 2.0 * pi * (k + 0.5) / azimuths;
                const glm::vec3 in(sine * std::cos(phi), sine * std::sin(phi), cosine(j));
                sum += evaluate(brdf, in, out).g;
            }
            kernel[static_cast<std::size_t>(i) * cosines + static_cast<std::size_t>(j)] =
                sum * 2.0 * pi / azimuths * cosine(j) / cosines;
        }
    }
    std::vector<double> radiance(cosines, 1.0);
    for (int step = 0; step < 400; ++step) {
        std::vector<double> next(cosines, 1.0);
        for (std::size_t i = 0; i < kernel.size(); ++i) {
            next[i / cosines] += kernel[i] * radiance[i % cosines];
        }
        radiance = next;
    }
    double irradiance = 0.0;
    for (int i = 0; i < cosines; ++i) {
        irradiance += 2.0 * pi * radiance[static_cast<std::size_t>(i)] * cosine(i) / cosines;
    }
    return irradiance;
}

/// A glossy furnace, all orders of reflection. 0.5 % for the facets of the sphere.
TEST(GlossyFurnace, SphereHasTheIrradianceOfItsIntegralEquation) {
    std::vector<NamedMaterial> materials = glossy_materials();
    materials[0].material.base_colour = glm::vec3(0.95F);  // its gloss is slight: many bounces
    for (NamedMaterial& named : materials) {
        named.material.emission = glm::vec3(1.0F);
        SceneBuilder b;
        b.set_transform(odd_rotation());
        add_sphere(b, glm::vec3(0.0F), 1.0F, 48, true, add_material(b, named.material));
        const Tracing t(b);
        const double exact =
            sphere_irradiance(make_brdf(named.material, named.material.base_colour));
        const Estimate e = mean_irradiance(
            t.scene, t.tracer, 0, static_cast<std::uint32_t>(b.mesh.patch_count()), 60'000);
        EXPECT_NEAR(e.mean, exact, sigmas * e.standard_error + 0.005 * exact) << named.name;
        EXPECT_LT(e.standard_error, 0.005 * exact) << named.name;
    }
}

/// A white dielectric coat over white Lambert reflects the same share of all light at every angle:
/// scaled down it makes a glossy furnace with the closed form pi Le/(1 - albedo) of a Lambert one.
/// 0.5 % for what of the share still depends on the angle.
TEST(GlossyFurnace, ConstantAlbedoHasTheClosedForm) {
    for (const float roughness : {0.1F, 0.3F, 0.7F}) {
        SceneBuilder b = furnace_room(1.0F, 100.0F);
        Material& coat = b.scene.materials[0];
        coat.specular = 1.0F;
        coat.roughness = roughness;
        coat.reflectance = 0.75F;
        const double albedo = test::albedo_by_quadrature(make_brdf(coat, coat.base_colour), 0.6F).g;
        ASSERT_NEAR(albedo, 0.75, 0.005);
        const double exact = pi * 100.0 / (1.0 - albedo);
        const Tracing t(b);
        const Estimate e = mean_irradiance(
            t.scene, t.tracer, 0, static_cast<std::uint32_t>(b.mesh.patch_count()), 100'000);
        EXPECT_NEAR(e.mean, exact, sigmas * e.standard_error + 0.005 * exact) << roughness;
        EXPECT_LT(e.standard_error, 0.003 * exact) << roughness;
    }
}

/// White surfaces in a furnace, N reflections: no more than (N + 1) Le, and for a dielectric, whose
/// Lambert part takes what the lobe leaves, hardly less (scene/material/brdf.h: 0.4 % each time).
/// Rough metal loses what its facets would reflect to each other.
TEST(GlossyFurnace, WhiteSurfacesNeverCreateEnergy) {
    constexpr int bounces = 12;
    PathSettings settings;
    settings.max_bounces = bounces;
    settings.certain_bounces = bounces;
    for (const float metallic : {0.0F, 1.0F}) {
        for (const float roughness : {0.1F, 0.4F, 1.0F}) {
            SceneBuilder b = furnace_room(1.0F, 1.0F);
            b.scene.materials[0].metallic = metallic;
            b.scene.materials[0].roughness = roughness;
            b.scene.materials[0].specular = 1.0F;
            const Tracing t(b, settings);
            const Estimate e = mean_irradiance(
                t.scene, t.tracer, 0, static_cast<std::uint32_t>(b.mesh.patch_count()), 20'000);
            EXPECT_LT(e.mean / pi, bounces + sigmas * e.standard_error / pi)
                << metallic << " " << roughness;
            EXPECT_GT(e.mean / pi, (metallic > 0.0F ? 0.1 : 0.97) * bounces)
                << metallic << " " << roughness;
            EXPECT_LT(e.standard_error, 0.01 * e.mean) << metallic << " " << roughness;
        }
    }
}

}  // namespace
}  // namespace raybundle
