// SPDX-License-Identifier: Apache-2.0
// What others' files broke: the light of the solver on the floors of tests/cases.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <string>
#include <vector>

#include "../unit/case_files.h"
#include "scene/mesh/patch_mesh.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::test {
namespace {

class Floor {
  public:
    explicit Floor(const std::string& name, const SceneSettings& settings = {})
        : scene_(load_gltf(case_path(name), settings)), mesh_(meshed(scene_)) {
        solver_.emplace(scene_, mesh_);
        programs_.emplace(solver_->scene());
    }

    /// Illuminance at a point, mean over a square of 20 mm, lx.
    double illuminance(const glm::vec3& point, int iterations = 0) {
        constexpr glm::uvec2 size(4, 4);
        ViewerImage image(solver_->scene(), solver_->store(), *programs_, size);
        Camera camera;
        camera.eye = point + glm::vec3(0, 1, 0);
        camera.target = point;
        camera.up = {0, 0, -1};
        camera.vertical_fov = 0.02F;
        image.set_camera(camera);
        BundleReceiver* const receivers[] = {&image};
        for (int i = 0; i < iterations; ++i) {
            solver_->step(receivers);
        }
        double sum = 0.0;
        for (unsigned i = 0; i < size.x * size.y; ++i) {
            const auto probe = image.probe({i % size.x, i / size.x});
            EXPECT_TRUE(probe);
            sum += probe ? static_cast<double>(probe->irradiance.g) : 0.0;
        }
        return sum / (size.x * size.y);
    }

  private:
    static PatchMesh meshed(Scene& scene) {
        TessellationSettings settings;
        settings.target_patches = 2000;
        return tessellate(scene, settings);
    }

    Scene scene_;
    PatchMesh mesh_;
    std::optional<Solver> solver_;
    std::optional<ViewPrograms> programs_;
};

Floor below_lamp(const std::string& ies) {
    SceneSettings settings;
    settings.ies = {"lamp=" + case_path("ies/" + ies)};
    return Floor("ies/floor.gltf", settings);
}

TEST(CasesLight, PhotometricFiles) {
    for (const char* file : {"05_bom_2019_factor.ies", "08b_decimal_comma_in_table.ies"}) {
        EXPECT_NEAR(below_lamp(file).illuminance({0, 0, 0}), 250.0, 1.0) << file;
    }
    Floor open("ies/open_345.gltf");
    for (const double degrees : {0.0, 90.0, 345.0, 352.5, 357.0}) {
        const double a = glm::radians(degrees);
        EXPECT_NEAR(open.illuminance({2.0 * std::cos(a), 0, -2.0 * std::sin(a)}), 62.5, 0.3);
    }
}

TEST(CasesLight, MirroredLuminaires) {
    for (const char* file : {"ies/plain.gltf", "ies/mirror_x.gltf"}) {
        Floor floor(file);
        EXPECT_NEAR(floor.illuminance({0, 0, -3}), 39.28, 0.3) << file;
        EXPECT_NEAR(floor.illuminance({0, 0, 3}), 10.0 * std::sqrt(0.5) / 18.0, 0.01) << file;
    }
}

TEST(CasesLight, HardSpots) {
    Floor floor("spot/hard_edge.gltf");
    EXPECT_NEAR(floor.illuminance({0, 0, 0}), 111.1, 0.3);
    EXPECT_NEAR(floor.illuminance({0.928F, 0, 0}), 96.9, 0.3);
    EXPECT_EQ(floor.illuminance({1.639F, 0, 0}), 0.0);
}

/// The sun of 10 000 lx goes straight through what covers 0.4.
TEST(CasesLight, FilmOfConstantAlpha) {
    Floor floor("glazing/texture_alpha40.gltf");
    EXPECT_NEAR(floor.illuminance({0, 0, 0}, 256), 6000.0, 150.0);
}

/// Irradiance at the middle of a square floor below a square pane that is parallel to it, from what
/// the pane emits and both reflect between them (radiosity of squares).
double below_pane(double floor_edge, double pane_edge, double height, double emitted,
                  double floor_albedo, double pane_albedo) {
    constexpr int kCells = 24;
    const auto centre = [](int cell, double edge) { return edge * ((cell + 0.5) / kCells - 0.5); };
    const auto exchange = [height](double dx, double dz) {  // per square metre of the sender
        const double squared = height * height + dx * dx + dz * dz;
        return height * height / (glm::pi<double>() * squared * squared);
    };
    const auto received = [&](double x, double z, double edge, const std::vector<double>& sent) {
        double sum = 0.0;
        for (int i = 0; i < kCells * kCells; ++i) {
            sum += sent[static_cast<std::size_t>(i)] *
                   exchange(centre(i % kCells, edge) - x, centre(i / kCells, edge) - z);
        }
        return sum * std::pow(edge / kCells, 2.0);
    };
    std::vector<double> pane(kCells * kCells, emitted);
    std::vector<double> floor(kCells * kCells, 0.0);
    for (int bounce = 0; bounce < 8; ++bounce) {
        for (int i = 0; i < kCells * kCells; ++i) {
            floor[static_cast<std::size_t>(i)] =
                floor_albedo * received(centre(i % kCells, floor_edge),
                                        centre(i / kCells, floor_edge), pane_edge, pane);
        }
        for (int i = 0; i < kCells * kCells; ++i) {
            pane[static_cast<std::size_t>(i)] =
                emitted + pane_albedo * received(centre(i % kCells, pane_edge),
                                                 centre(i / kCells, pane_edge), floor_edge, floor);
        }
    }
    return received(0.0, 0.0, pane_edge, pane);
}

/// KHR_materials_transmission: base colour (0.5) times transmission (0.4) of what the boundaries
/// do not reflect passes: 0.923 of a pane of n = 1.5, 1846 of the sun's 10 000 lx. (A white pane:
/// 3700 lx.) Less than a half passes, so the pane is a veil here, which sends the 1846 lm/m² in all
/// directions instead of straight down: 0.83 of a square of 8 m at 2 m reach the floor's middle,
/// and the pane's other 0.6 x 0.5 reflect a tenth more back to it.
TEST(CasesLight, PaneThatTransmitsLessThanAHalf) {
    const double passing = 10000.0 * 0.4 * 0.5 * 0.923;
    const double corner =
        2.0 / std::sqrt(5.0) * std::atan(2.0 / std::sqrt(5.0)) / glm::pi<double>();
    EXPECT_NEAR(below_pane(6.0, 8.0, 2.0, passing, 0.0, 0.0), 4.0 * corner * passing, 2.0)
        << "form factor of a parallel square";
    const double right = below_pane(6.0, 8.0, 2.0, passing, 0.5, 0.6 * 0.5);
    Floor floor("glazing/transmission40.gltf");
    EXPECT_NEAR(floor.illuminance({0, 0, 0}, 512), right, 0.02 * right);
}

}  // namespace
}  // namespace raybundle::test
