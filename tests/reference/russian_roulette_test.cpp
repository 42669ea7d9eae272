// SPDX-License-Identifier: Apache-2.0
// Chapter 3: survival probabilities keep the mean, and have the variance that the chapter says.
#include "reference/sampling/russian_roulette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rooms.h"
#include "roulette_study.h"

namespace raybundle {
namespace {

using std::numbers::pi;

/// Every policy is unbiased, with and without next-event estimation, also on coloured and glossy
/// surfaces: mean irradiance of a furnished room against the policy by throughput.
TEST(RussianRoulette, PoliciesKeepTheMean) {
    SceneBuilder b = enclosure(0.7F);
    b.add_box({1, 0, 1}, {2.5F, 1, 2.5F}, false, 1,
              add_material(b, glossy_materials()[2].material));
    const auto last = static_cast<std::uint32_t>(b.mesh.patch_count());
    const auto measure = [&](const PathSettings& settings, std::uint64_t seed) {
        const Tracing t(b, settings);
        return mean_irradiance(t.scene, t.tracer, 0, last, 100'000, seed);
    };
    const Estimate reference = measure({}, 1);
    for (const bool next_event : {true, false}) {
        PathSettings settings;
        settings.next_event = next_event;
        settings.certain_bounces = 1;
        settings.survival = Survival::albedo;
        const Estimate albedo = measure(settings, 2);
        EXPECT_NEAR(albedo.mean, reference.mean,
                    sigmas * std::hypot(albedo.standard_error, reference.standard_error));
        EXPECT_LT(albedo.standard_error, 0.02 * albedo.mean);
        for (const double probability : {0.6, 0.9}) {
            settings.survival = Survival::fixed;
            settings.survival_probability = probability;
            const Estimate fixed = measure(settings, 3);
            EXPECT_NEAR(fixed.mean, reference.mean,
                        sigmas * std::hypot(fixed.standard_error, reference.standard_error))
                << probability;
            EXPECT_LT(fixed.standard_error, 0.03 * fixed.mean) << probability;
        }
    }
}

/// For one reflection that may be followed by another the optimum has a closed form (ch. 3.3.2).
TEST(RussianRoulette, OptimumOfTwoReflectionsIsItsClosedForm) {
    for (const double a : {0.3, 0.5, 0.6}) {
        const WalkStatistics w{a, 0.29, 0.2};
        const double square =
            a * a * w.mean_square / (w.variance + a * a * w.variance - a * a * w.mean_square);
        const double exact = std::clamp(std::sqrt(square), a, 1.0);
        EXPECT_NEAR(optimal_survival(w, 2), exact, 1e-3) << a;
    }
}

/// Eq. 3.14, three reflections, written out.
TEST(RussianRoulette, VarianceOfThreeReflectionsIsThatOfTheDissertation) {
    const WalkStatistics w{0.47, 0.29, 0.137};
    const double a2 = w.albedo * w.albedo;
    const double a4 = a2 * a2;
    const double d = w.variance * (1.0 + a2 + a4);
    const double e = w.mean_square;
    for (const double s : {0.2, 0.6, 1.0}) {
        const double exact = s * s * (d - e * (a2 + a4)) + s * (d - e * a4) + d +
                             e * (a2 + a4) / s + e * a4 / (s * s);
        EXPECT_NEAR(walk_variance(w, s, 3), exact, 1e-12) << s;
    }
}

/// Figures 3.3 and 3.4: where the variance is high the optimum is near the albedo, where it is low
/// it is 1 for albedos above 0.4.
TEST(RussianRoulette, OptimumIsBetweenTheAlbedoAndOne) {
    for (const double a : {0.2, 0.4, 0.6, 0.8}) {
        EXPECT_NEAR(optimal_survival({a, 0.29, 0.2}, 7), a, 0.15) << a;
        EXPECT_GE(optimal_survival({a, 0.29, 0.2}, 7), a) << a;
    }
    for (const double a : {0.45, 0.6, 0.9}) {
        EXPECT_EQ(optimal_survival({a, 0.29, 0.02}, 7), 1.0) << a;
    }
    EXPECT_NEAR(optimal_survival({0.0, 0.29, 0.2}, 7), 0.0, 2e-3);
}

/// Statistics of a furnace are known: every first reflection finds a Le.
TEST(RussianRoulette, FurnaceHasNoVariance) {
    const SceneBuilder room = furnace_room(0.5F, 100.0F);
    const RayScene scene(room.scene, room.mesh);
    Camera camera;
    camera.eye = glm::vec3(odd_rotation() * glm::vec4(1, 1, 1, 1));
    camera.target = glm::vec3(odd_rotation() * glm::vec4(2, 1, 1, 1));
    const WalkStatistics w = measure_walks(scene, CameraRays(scene, camera, {8, 8}), 16, 1);
    EXPECT_NEAR(w.albedo, 0.5, 1e-6);
    EXPECT_NEAR(w.mean_square, 2500.0, 0.01);
    EXPECT_NEAR(w.variance, 0.0, 0.01);
    EXPECT_EQ(optimal_survival(w, 7), 1.0);
}

/// Figure 3.6. In a constant scene a walk of K steps is worth (1 - r^(K+1))/(1 - r), r = a/s, with
/// K geometrically distributed: its variance falls all the way to s = 1.
void expect_closed_form(std::initializer_list<double> probabilities) {
    const WalkScene scene = constant_scene();
    const double a = 0.1 * pi;
    double before = INFINITY;
    for (const double s : probabilities) {
        const double r = a / s;
        const double mean = r * (1.0 - s) / (1.0 - a);
        const double square = r * r * (1.0 - s) / (1.0 - a * a / s);
        const double exact =
            a * a * (square - mean * mean) / ((1.0 - r) * (1.0 - r)) / (100.0 * (1.0 - s));
        const WalkVariance measured = measure_variance(scene, s, 4'000, 100.0);
        EXPECT_NEAR(measured.variance, exact, sigmas * measured.standard_error) << s;
        EXPECT_LT(measured.standard_error, 0.02 * exact) << s;
        EXPECT_LT(measured.variance, before) << s;
        before = measured.variance;
    }
}

TEST(RussianRoulette, ConstantSceneHasItsVarianceInClosedForm) {
    expect_closed_form({0.3, 0.6});
}

TEST(HeavyRussianRoulette, ConstantSceneHasItsVarianceInClosedForm) {
    expect_closed_form({0.3, 0.5, 0.7, 0.9});
}

/// Figure 3.7: with a lamp among dark surfaces walks can be too long, and the best length grows
/// with the albedo.
TEST(HeavyRussianRoulette, LampMakesLongWalksWastefulTheMoreSoTheDarkerItIs) {
    const auto price_of_long_walks = [](float albedo) {
        const WalkScene scene = lamp_scene(albedo);
        const WalkVariance middle = measure_variance(scene, 0.5, 2'000, 100.0);
        const WalkVariance longer = measure_variance(scene, 0.9, 2'000, 100.0);
        return longer.variance / middle.variance;
    };
    const double dark = price_of_long_walks(0.1F * glm::pi<float>());
    const double bright = price_of_long_walks(0.15F * glm::pi<float>());
    EXPECT_GT(dark, 1.5);
    EXPECT_LT(bright, 0.9 * dark);
}

}  // namespace
}  // namespace raybundle
