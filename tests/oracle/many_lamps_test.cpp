// SPDX-License-Identifier: Apache-2.0
// More punctual lights than there are shadow maps for: closed forms, and the same lights as the sum
// of few.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../reference/lit_room.h"
#include "changed_room.h"
#include "solution/direct/many_lamps.h"

namespace raybundle::many_lamps_test {
namespace {

using std::numbers::pi;

constexpr float side = 24.0F;  // m, of the floor
constexpr glm::vec3 down{0.0F, -1.0F, 0.0F};

/// Lamps of 1 to 3 times 20 cd over a floor, 2 to 4 m above it, the same each time.
void add_lamps(SceneBuilder& b, unsigned first, unsigned end, unsigned all) {
    const auto columns = static_cast<unsigned>(std::ceil(std::sqrt(static_cast<double>(all))));
    for (unsigned k = first; k < end; ++k) {
        const float x = (static_cast<float>(k % columns) + 0.5F) / static_cast<float>(columns);
        const float z = (static_cast<float>(k / columns) + 0.5F) / static_cast<float>(columns);
        const PunctualKind kind = k % 3 == 2 ? PunctualKind::spot : PunctualKind::point;
        add_punctual_light(
            b, glm::mat4(1.0F), kind,
            {side * (x - 0.5F), 2.0F + static_cast<float>(k * 7 % 11) * 0.2F, side * (z - 0.5F)},
            {0.2F, -1.0F, 0.1F}, glm::vec3(20.0F * static_cast<float>(1 + k % 3)));
    }
}

/// A floor and, where there is one, an object 1 that throws shadows on it.
SceneBuilder lit_floor(unsigned first, unsigned end, unsigned all, bool box, float albedo = 0.0F) {
    SceneBuilder b;
    const auto grey = b.add_material(glm::vec3(albedo));
    b.add_quad({-0.5F * side, 0, -0.5F * side}, {0, 0, side}, {side, 0, 0}, 24, 24, grey);
    if (box) {
        b.add_object("box");
        b.add_box({-2, 0.4F, -1}, {1, 1.4F, 2}, false, 2, grey);
    }
    add_lamps(b, first, end, all);
    return b;
}

/// Illuminance of the floor by all lamps, lx, nothing in their way.
double exact(const Scene& scene, const glm::dvec3& point) {
    double sum = 0.0;
    for (const PunctualLight& light : scene.punctual_lights) {
        const PlacedLight lamp = place_light(scene, light);
        const glm::dvec3 to = lamp.position - point;
        const double distance = glm::length(to);
        sum += lamp.towards(-to / distance).g * to.y / (distance * distance * distance);
    }
    return sum;
}

Camera from_above() {
    Camera camera;
    camera.eye = {0, 14, -12};
    camera.target = {0, 0, 0};
    return camera;
}

/// A scene, and a viewer at rest who looks at it from above.
struct Viewed {
    Viewed(const SceneBuilder& b, glm::uvec2 size)
        : solver(b.scene, b.mesh),
          programs(solver.scene()),
          image(solver.scene(), solver.store(), programs, size) {
        image.set_camera(from_above());
        image.rest();
    }

    Solver solver;
    ViewPrograms programs;
    ViewerImage image;
};

void finish(Solver& solver, ViewerImage& image) {
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < 4000 && !(solver.store().first_shot()->many()->complete() &&
                                  image.lamps_exact() && solver.between_groups());
         ++i) {
        solver.step(receivers);
    }
    ASSERT_TRUE(image.lamps_exact());
    for (int i = 0; i < 16; ++i) {  // so that all that has been found is in effect
        solver.step(receivers);
    }
}

std::vector<double> of_patches(const Solver& solver) {
    std::vector<double> result;
    for (const glm::vec3& value : solver.store().first_shot()->read_irradiance()) {
        result.push_back(static_cast<double>(value.g * solver.scene().radiance_unit()));
    }
    return result;
}

struct Deviation {
    double mean = 0.0, rms = 0.0, worst = 0.0;  // relative to the mean
};

Deviation deviation(const std::vector<double>& found, const std::vector<double>& truth) {
    double sum = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        sum += found[i];
        all += truth[i];
    }
    Deviation result;
    result.mean = sum / all - 1.0;
    const double level = all / static_cast<double>(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double off = std::abs(found[i] - truth[i]) / level;
        result.worst = std::max(result.worst, off);
        result.rms += off * off / static_cast<double>(truth.size());
    }
    result.rms = std::sqrt(result.rms);
    return result;
}

/// Illuminance at pixels, lx; -1: of none.
std::vector<double> of_pixels(ViewerImage& image) {
    std::vector<double> result;
    for (unsigned i = 0; i < 256; ++i) {
        const auto probe = image.probe({i % 16, i / 16});
        result.push_back(probe ? static_cast<double>(probe->irradiance.g) : -1.0);
    }
    return result;
}

/// Of a scene, without bundles.
std::vector<double> fresh_pixels(const SceneBuilder& b) {
    const Solver solver(b.scene, b.mesh);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {16, 16});
    image.set_camera(from_above());
    return of_pixels(image);
}

class ManyLampsOver : public testing::TestWithParam<unsigned> {};

/// Every pixel has the sum of the inverse squares in the end, and says from the beginning how far
/// it is from that.
TEST_P(ManyLampsOver, AFloorGiveTheSumOfInverseSquares) {
    SceneBuilder b = lit_floor(0, GetParam(), GetParam(), false);
    Viewed viewed(b, {32, 32});
    Solver& solver = viewed.solver;
    ViewerImage& image = viewed.image;
    const auto errors = [&] {
        double square = 0.0;
        double all = 0.0;
        for (unsigned i = 0; i < 64; ++i) {
            const auto probe = image.probe({4 * (i % 8), 4 * (i / 8)});
            if (probe) {
                const double truth = exact(b.scene, glm::dvec3(probe->position));
                square += std::pow(static_cast<double>(probe->irradiance.g) - truth, 2);
                all += truth * truth;
            }
        }
        return std::sqrt(square / all);
    };
    // By chance, but of the right level: one part in twenty of the light is drawn.
    EXPECT_LT(errors(), 0.3);
    finish(solver, image);
    EXPECT_LT(errors(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Lamps, ManyLampsOver, testing::Values(600U));
INSTANTIATE_TEST_SUITE_P(HeavyLamps, ManyLampsOver, testing::Values(2000U));

/// What has not been looked at is estimated without bias: mean over the floor.
TEST(ManyLamps, PatchesHaveTheRightLevelAtOnce) {
    SceneBuilder b = lit_floor(0, 2000, 2000, false);
    const Solver solver(b.scene, b.mesh);
    std::vector<double> truth;
    for (std::size_t i = 0; i < b.mesh.triangles.size(); ++i) {
        truth.push_back(exact(b.scene, glm::dvec3(b.cell_centre(i))));
    }
    const Deviation found = deviation(of_patches(solver), truth);
    EXPECT_NEAR(found.mean, 0.0, 0.02);
    EXPECT_LT(found.worst, 0.6);
}

/// With shadows: 400 lamps are the sum of two halves that have shadow maps.
TEST(ManyLamps, AreTheSumOfFew) {
    SceneBuilder all = lit_floor(0, 400, 400, true);
    SceneBuilder one = lit_floor(0, 200, 400, true);
    SceneBuilder other = lit_floor(200, 400, 400, true);
    Viewed viewed(all, {16, 16});
    Solver& solver = viewed.solver;
    ViewerImage& image = viewed.image;
    finish(solver, image);
    std::vector<double> truth = of_patches(Solver(one.scene, one.mesh));
    const std::vector<double> rest = of_patches(Solver(other.scene, other.mesh));
    for (std::size_t i = 0; i < truth.size(); ++i) {
        truth[i] += rest[i];
    }
    const Deviation found = deviation(of_patches(solver), truth);
    EXPECT_NEAR(found.mean, 0.0, 5e-3);  // 4 points of a patch in the place of 16, or 1
    EXPECT_LT(found.rms, 0.05);
    const std::vector<double> pixels = of_pixels(image);
    const std::vector<double> some = fresh_pixels(one);
    const std::vector<double> others = fresh_pixels(other);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (pixels[i] >= 0.0) {
            EXPECT_NEAR(pixels[i], some[i] + others[i], 2e-3 * pixels[i] + 1e-3) << i;
        }
    }
}

/// One of many is switched off: its light is gone at once, and no other.
TEST(ManyLamps, OneThatGoesOutTakesItsLightAlone) {
    SceneBuilder b = lit_floor(0, 600, 600, false);
    b.scene.punctual_lights[300].intensity *= 40.0F;
    Viewed viewed(b, {16, 16});
    Solver& solver = viewed.solver;
    ViewerImage& image = viewed.image;
    finish(solver, image);
    const std::vector<double> before = of_patches(solver);
    b.scene.punctual_lights[300].intensity = glm::vec3(0.0F);
    BundleReceiver* const receivers[] = {&image};
    solver.change_surfaces(b.scene, b.mesh, {}, {}, receivers);
    const std::vector<double> after = of_patches(solver);
    std::vector<double> truth;
    for (std::size_t i = 0; i < b.mesh.triangles.size(); ++i) {
        truth.push_back(exact(b.scene, glm::dvec3(b.cell_centre(i))));
    }
    EXPECT_NEAR(deviation(after, truth).mean, 0.0, 0.01);  // of centroids
    EXPECT_LT(deviation(after, truth).rms, 0.05);
    EXPECT_GT(deviation(before, truth).worst, 0.2);
    for (unsigned i = 0; i < 16; ++i) {
        const auto probe = image.probe({i, 7});
        if (probe) {
            const double there = exact(b.scene, glm::dvec3(probe->position));
            EXPECT_NEAR(static_cast<double>(probe->irradiance.g), there, 2e-3 * there);
        }
    }
}

/// An object moves among them: its shadows go along, at once as far as the nearest lamps throw
/// them, and all of them in the end.
TEST(ManyLamps, ShadowsFollowWhatMoves) {
    SceneBuilder b = lit_floor(0, 400, 400, true);
    Viewed viewed(b, {16, 16});
    Solver& solver = viewed.solver;
    ViewerImage& image = viewed.image;
    finish(solver, image);
    const std::vector<double> before = of_patches(solver);
    BundleReceiver* const receivers[] = {&image};
    const glm::mat4 there = glm::translate(glm::mat4(1.0F), glm::vec3(5, 0, 3));
    solver.move_object(1, there, receivers);
    const std::vector<double> at_once = of_patches(solver);
    finish(solver, image);
    const std::vector<double> after = of_patches(solver);
    // The floor's patches come first. Those of the box have other lamps near them.
    const auto floor_of = [](std::vector<double> all) {
        all.resize(2 * 24 * 24);
        return all;
    };
    EXPECT_GT(deviation(before, after).worst, 0.3);
    EXPECT_LT(deviation(floor_of(at_once), floor_of(after)).rms, 0.05);
    EXPECT_LT(deviation(at_once, after).rms, 0.05);
    b.scene.objects[1].transform.translation = {5, 0, 3};
    Viewed fresh(b, {16, 16});
    finish(fresh.solver, fresh.image);
    EXPECT_LT(deviation(after, of_patches(fresh.solver)).rms, 0.05);  // by other points of patches
    const std::vector<double> pixels = of_pixels(image);
    const std::vector<double> truth = of_pixels(fresh.image);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        EXPECT_NEAR(pixels[i], truth[i], 1e-3 * truth[i] + 1e-3) << i;
    }
}

}  // namespace
}  // namespace raybundle::many_lamps_test
