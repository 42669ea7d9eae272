// SPDX-License-Identifier: Apache-2.0
// The floor beside a slot that is far thinner than a bundle's pixel, with light in it.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "oracle/scene_builder.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::slot_test {
namespace {

constexpr float albedo = 0.5F;
constexpr float half_length = 2.0F;  // m, of the board
constexpr double lamp_luminance = 1e4;
constexpr std::uint64_t iterations = 1024;

/// What differs from slot to slot.
struct Slot {
    std::string name;
    float gap = 0.002F;  // m
    StrategyProbabilities strategies{};
    unsigned cells = 8;  // along the edges of the board
    bool moved = false;  // the board has been elsewhere before
};

void PrintTo(const Slot& slot, std::ostream* out) {
    *out << slot.name;
}

/// In a black room of 8 m a board of 0.5 x 4 m hangs above the floor, its underside a lamp, its
/// edge at x = 0. Nothing but the floor reflects.
SceneBuilder lit_slot(const Slot& slot) {
    SceneBuilder b;
    const auto black = b.add_material(glm::vec3(0.0F));
    const auto floor = b.add_material(glm::vec3(albedo));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(float{lamp_luminance}));
    b.add_box({-4, -4, -4}, {4, 4, 4}, true, 2, black);
    b.add_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 8, 8, floor);
    const std::size_t first = b.mesh.triangles.size();
    b.add_object("board");
    b.add_box({-0.5F, slot.gap, -half_length}, {0, 0.1F, half_length}, false, slot.cells, black);
    for (std::size_t t = first; t < b.mesh.triangles.size(); ++t) {
        if (std::abs(b.cell_centre(t).y - slot.gap) < 1e-5F) {
            b.set_triangle_material(t, lamp);
        }
    }
    return b;
}

/// Illuminance at a distance x (m) from the board's edge, lx: a long strip's, whose form factor is
/// half of the difference of the sines of the angles to its edges (R. Siegel, J. R. Howell,
/// "Thermal Radiation Heat Transfer"). Of this one's length 0.02 % are missing.
double illuminance(double x, double gap) {
    const auto sine = [gap](double at) { return at / std::hypot(at, gap); };
    return 0.5 * std::acos(-1.0) * lamp_luminance * (sine(x + 0.5) - sine(x));
}

/// Straight above the floor from 2 to 38 mm beside the board, tilted along it.
Camera beside_the_slot() {
    Camera camera;
    camera.eye = {0.02F, 1.0F, 0.5F};
    camera.target = {0.02F, 0.0F, 0.0F};
    camera.vertical_fov = static_cast<float>(2.0 * std::atan(0.018 / std::hypot(1.0, 0.5)));
    return camera;
}

class LitSlot : public testing::TestWithParam<Slot> {};

TEST_P(LitSlot, LightsTheFloorBesideItAsAStripDoes) {
    const Slot& slot = GetParam();
    const SceneBuilder b = lit_slot(slot);
    SolverSettings settings;
    settings.coarse = {128, 200};  // a window's pixel is 70 mm wide
    settings.probabilities = slot.strategies;
    Solver solver(b.scene, b.mesh, settings);
    const ViewPrograms programs(solver.scene());
    constexpr glm::uvec2 size(24, 24);
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    image.set_camera(beside_the_slot());
    BundleReceiver* const receivers[] = {&image};
    const auto run = [&](std::uint64_t count) {
        for (std::uint64_t i = 0; i < count; ++i) {
            solver.step(receivers);
        }
    };
    if (slot.moved) {
        const auto put = [&](const glm::vec3& place) {
            solver.move_object(1, glm::translate(glm::mat4(1.0F), place), receivers);
        };
        put({1.0F, 1.0F, 0.0F});
        run(64);
        put({0.0F, 0.0F, 0.0F});
        image.restart(beside_the_slot(), size);
    }
    image.rest();
    run(iterations);
    double found = 0.0;
    double exact = 0.0;
    const auto picture = image.read_radiance();
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            // Rows nearer to the eye show a little less of the floor, others a little more.
            exact += illuminance(0.02 + 0.036 * ((x + 0.5) / size.x - 0.5), slot.gap);
            found += double{picture[y * size.x + x].x} * std::acos(-1.0) / double{albedo};
        }
    }
    EXPECT_NEAR(found / exact, 1.0, 0.06);
}

// Of a slot so thin a perspective or plane bundle alone brings nearly all light in very few of its
// iterations.
constexpr StrategyProbabilities layered{1.0F, 0.0F, 0.0F};
constexpr StrategyProbabilities with_planes{0.5F, 0.5F, 0.0F};
constexpr StrategyProbabilities with_perspective{0.2F, 0.0F, 0.8F};

INSTANTIATE_TEST_SUITE_P(Slots, LitSlot,
                         testing::Values(Slot{"Layered2Millimetres", 0.002F, layered},
                                         Slot{"WithPlanes6Millimetres", 0.006F, with_planes},
                                         Slot{"WithPerspective16Millimetres", 0.016F,
                                              with_perspective},
                                         Slot{"Combined2Millimetres"},
                                         Slot{"UnderABoardThatWasElsewhere", 0.006F, {}, 8, true}),
                         [](const testing::TestParamInfo<Slot>& slot) { return slot.param.name; });
INSTANTIATE_TEST_SUITE_P(HeavySlots, LitSlot,
                         testing::Values(Slot{"Layered6Millimetres", 0.006F, layered},
                                         Slot{"Layered16Millimetres", 0.016F, layered},
                                         Slot{"UnderABoardCutFinely", 0.006F, {}, 32}),
                         [](const testing::TestParamInfo<Slot>& slot) { return slot.param.name; });

}  // namespace
}  // namespace raybundle::slot_test
