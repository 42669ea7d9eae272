// SPDX-License-Identifier: Apache-2.0
// Luminaires that shine from an area: pixels, patches and shadows against sums over the area.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../reference/lit_room.h"
#include "../reference/luminous_panel.h"
#include "solution/geometry/light_slots.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::luminous_opening_test {
namespace {

const glm::dvec3 up(0.0, 1.0, 0.0);

/// A black floor of 8 m x 8 m in n x n cells.
SceneBuilder black_floor(std::uint32_t n) {
    SceneBuilder b;
    b.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, n, n, b.add_material(glm::vec3(0.0F)));
    return b;
}

/// Calls take(position, irradiance) for pixels of a camera that looks down at the floor.
template <class Take>
void look_at_floor(const SceneBuilder& b, const Take& take) {
    const Solver solver(b.scene, b.mesh);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {40, 30});
    Camera camera;
    camera.eye = {0, 4, -0.5F};
    camera.target = {0, 0, 0};
    image.set_camera(camera);
    for (unsigned x = 1; x < 40; x += 3) {
        for (unsigned y = 1; y < 30; y += 3) {
            if (const auto probe = image.probe({x, y})) {
                take(glm::dvec3(probe->position), static_cast<double>(probe->irradiance.g));
            }
        }
    }
}

struct Panel {
    const char* name;
    double height;
    double along_x, along_y;  ///< along_y 0: round
    std::uint32_t cells;      ///< of the floor: patches of 0.5 m divide it, those of 2 m do not
};

class PanelAbove : public testing::TestWithParam<Panel> {};

/// The bound that shaders/solution/opening.glsl derives, and 0.1 % of the file's steps.
TEST_P(PanelAbove, LightsPixelsAsItsAreaDoes) {
    const Panel& panel = GetParam();
    SceneBuilder b = black_floor(panel.cells);
    b.scene.punctual_lights.push_back(
        panel_light({{0.2F, static_cast<float>(panel.height), -0.1F}, {0, -1, 0}, 25.0F},
                    panel.along_x, panel.along_y));
    int seen = 0;
    look_at_floor(b, [&](const glm::dvec3& position, double found) {
        const double exact = panel_illuminance(b.scene.punctual_lights[0], panel.along_x,
                                               panel.along_y, position, up);
        EXPECT_NEAR(found, exact, 6e-3 * exact) << position.x << " " << position.z;
        ++seen;
    });
    EXPECT_GT(seen, 50);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, PanelAbove,
    testing::Values(Panel{"At03", 0.3, 0.6, 0.6, 16}, Panel{"At1", 1.0, 0.6, 0.6, 16},
                    Panel{"At3", 3.0, 0.6, 0.6, 16}, Panel{"WholeAt03", 0.3, 0.6, 0.6, 4},
                    Panel{"LongAt03", 0.3, 0.3, 1.2, 16}, Panel{"RoundAt03", 0.3, 0.6, 0.0, 16},
                    Panel{"RoundWholeAt1", 1.0, 0.6, 0.0, 4}),
    [](const auto& panel) { return std::string(panel.param.name); });

double flux_in_black_box(double along_x, double along_y, std::uint32_t cells) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {4, 3, 5}, true, cells, b.add_material(glm::vec3(0.0F)));
    b.scene.punctual_lights.push_back(
        panel_light({{1.1F, 2.3F, 1.9F}, glm::normalize(glm::vec3(0.3F, -1.0F, 0.4F)), 20.0F},
                    along_x, along_y));
    const Solver solver(b.scene, b.mesh);
    const auto irradiance = solver.store().read_irradiance();
    double flux = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const glm::uvec3& t = b.mesh.triangles[i];
        flux += 0.5 *
                static_cast<double>(
                    glm::length(glm::cross(b.mesh.positions[t.y] - b.mesh.positions[t.x],
                                           b.mesh.positions[t.z] - b.mesh.positions[t.x]))) *
                static_cast<double>(irradiance[i].g);
    }
    return flux;
}

TEST(PanelFlux, IsThatOfTheFile) {
    const double flux = panel_profile(0.6, 0.6)->flux();
    EXPECT_NEAR(flux_in_black_box(0.6, 0.6, 12), flux, 5e-3 * flux);
    EXPECT_NEAR(flux_in_black_box(0.6, 0.0, 12), flux, 5e-3 * flux);
    EXPECT_NEAR(flux_in_black_box(0.2, 0.1, 12), flux, 5e-3 * flux);  // is not divided
}

/// Below the edge of a screen half way up: quarters of the panel are seen or not, each with a
/// quarter of the light and its own cosine. Half of a step, 1/8, is what that leaves.
TEST(PanelShadow, OfAnEdgeHasFourSteps) {
    SceneBuilder b = black_floor(16);
    b.add_quad({-4, 1, -4}, {0, 0, 8}, {4, 0, 0}, 8, 8, 0);
    b.scene.punctual_lights.push_back(panel_light({{0, 2, 0}, {0, -1, 0}, 0.0F}, 0.6, 0.6));
    const PunctualLight& light = b.scene.punctual_lights[0];
    const Solver solver(b.scene, b.mesh);
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, {60, 20});
    Camera camera;  // between floor and screen
    camera.eye = {0.1F, 0.8F, -1.6F};
    camera.target = {0.1F, 0, 0};
    image.set_camera(camera);
    int half_lit = 0;
    double sum = 0.0;
    double exact_sum = 0.0;
    for (unsigned x = 0; x < 60; ++x) {
        for (unsigned y = 8; y < 12; ++y) {
            const auto probe = image.probe({x, y});
            if (!probe || std::abs(probe->position.y) > 1e-3F) {
                continue;
            }
            const glm::dvec3 at(probe->position);
            const auto illuminance = [&](const auto& sees) {
                return panel_illuminance(light, 0.6, 0.6, at, up, 40, sees);
            };
            const double free = illuminance([](const glm::dvec3&) { return true; });
            const double exact =
                illuminance([&](const glm::dvec3& place) { return 0.5 * (place.x + at.x) > 0.0; });
            const auto found = static_cast<double>(probe->irradiance.g);
            EXPECT_NEAR(found, exact, 0.14 * free) << at.x << " " << at.z;
            half_lit += exact > 0.05 * free && exact < 0.95 * free ? 1 : 0;
            sum += found;
            exact_sum += exact;
        }
    }
    EXPECT_GT(half_lit, 20);
    EXPECT_NEAR(sum, exact_sum, 0.02 * exact_sum);
}

// Which lights are divided.

PunctualLight numbered(PunctualLight light, std::uint32_t number) {
    AddedLuminaire added;
    added.number = number;
    light.added = std::make_shared<const AddedLuminaire>(added);
    return light;
}

double intensity_of(const LightSlots& slots) {
    double sum = 0.0;
    for (const PunctualLight& light : slots.lights()) {
        sum += static_cast<double>(light.intensity.g);
    }
    return sum;
}

TEST(LightSlots, LargeOpeningsAreQuarters) {
    Scene scene;
    const PunctualLight panel = panel_light({}, 0.6, 0.6);
    scene.punctual_lights = {panel_light({}, 0.1, 0.0), panel, panel_light({}, 0.2, 0.2)};
    const LightSlots slots(scene, 0.3);
    EXPECT_EQ(slots.lights().size(), 6U);
    EXPECT_NEAR(intensity_of(slots), 3.0, 1e-6);
    scene.punctual_lights = std::vector<PunctualLight>(65, panel);
    EXPECT_EQ(LightSlots(scene, 0.3).lights().size(), 65U) << "shadow maps are not given up for it";
    EXPECT_FALSE(slots.fit(scene));
}

TEST(LightSlots, AddedOnesHaveRoomForQuarters) {
    Scene scene;
    scene.punctual_lights = {numbered(panel_light({}, 0.6, 0.6), 1),
                             numbered(panel_light({}, 0.1, 0.1), 2)};
    LightSlots slots(scene, 0.3);
    EXPECT_EQ(slots.lights().size(), 32U);  // 8 slots
    EXPECT_NEAR(intensity_of(slots), 2.0, 1e-6);
    EXPECT_EQ(slots.lights()[3].part, 3);
    EXPECT_EQ(slots.lights()[4].part, PunctualLight::whole);
    scene.punctual_lights[0].removed = true;
    ASSERT_TRUE(slots.fit(scene));
    slots.update(scene);
    EXPECT_NEAR(intensity_of(slots), 1.0, 1e-6);
    EXPECT_EQ(slots.lights()[0].part, 0) << "an empty slot keeps the place of its light";
    scene.punctual_lights.push_back(numbered(panel_light({}, 0.6, 0.6), 3));
    slots.update(scene);
    EXPECT_NEAR(intensity_of(slots), 2.0, 1e-6);
    // Small ones alone have slots of one light, where a large one finds no room.
    scene.punctual_lights = {numbered(panel_light({}, 0.1, 0.1), 1)};
    const LightSlots small(scene, 0.3);
    EXPECT_EQ(small.lights().size(), 8U);
    scene.punctual_lights.push_back(numbered(panel_light({}, 0.6, 0.6), 2));
    EXPECT_FALSE(small.fit(scene));
}

}  // namespace
}  // namespace raybundle::luminous_opening_test
