// SPDX-License-Identifier: Apache-2.0
// What must not matter to a solution: how large the room is and where it stands, and values that
// are not finite.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hard_rooms.h"
#include "methods.h"
#include "oracle/oracle_solve.h"

namespace raybundle::invariance_test {
namespace {

std::string method_name(const testing::TestParamInfo<Method>& info) {
    return info.param.name;
}

const std::vector<Method>& strategies() {
    static const std::vector<Method> methods = {layered(), plane(), perspective(),
                                                three_strategies()};
    return methods;
}

/// A room with a lamp and a box, `scale` times as large.
SceneBuilder furnished_room(float scale) {
    SceneBuilder b;
    b.set_transform(glm::scale(odd_rotation(), glm::vec3(scale)));
    const auto wall = b.add_material(glm::vec3(0.6F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 4, wall);
    b.add_quad({1.5F, 2.9F, 2}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    b.add_box({1, 0, 1}, {2, 1.5F, 2}, false, 3, wall);
    return b;
}

void move_away(SceneBuilder& builder, const glm::vec3& by) {
    for (Object& object : builder.scene.objects) {
        object.transform.translation += by;
    }
    builder.scene.bounds.min += by;
    builder.scene.bounds.max += by;
}

/// sqrt(sum (a-b)^2 / sum b^2).
double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        size += b[i] * b[i];
    }
    return std::sqrt(difference / size);
}

constexpr std::uint64_t iterations = 128;

class Invariance : public testing::TestWithParam<Method> {
  protected:
    /// Largest relative difference. In a mixture rounding may decide between two shooters, which
    /// then share nothing: one bundle may be another one.
    [[nodiscard]] static double bound() {
        return GetParam().alone() ? 1e-3 : 1.0 / static_cast<double>(iterations);
    }
    [[nodiscard]] std::vector<double> solve(const SceneBuilder& builder,
                                            std::uint64_t seed = 1) const {
        OracleSettings settings;
        settings.iterations = iterations;
        settings.seed = seed;
        return irradiance_by(GetParam(), builder, settings);
    }
};

/// With the same random numbers, so that a relative difference of 1e-3 is far below the noise.
TEST_P(Invariance, ScaleDoesNotMatter) {
    const auto usual = solve(furnished_room(1.0F));
    EXPECT_GT(relative_difference(solve(furnished_room(1.0F), 2), usual), 0.01)
        << "the comparison sees nothing";
    for (const float scale : {1e-3F, 1e3F}) {
        EXPECT_LT(relative_difference(solve(furnished_room(scale)), usual), bound()) << scale;
    }
}

/// 10 km away world positions have a resolution of 1 mm: that of a file's coordinates is kept,
/// since the world is shifted before it is rounded.
TEST_P(Invariance, PlaceDoesNotMatter) {
    const auto usual = solve(furnished_room(1.0F));
    SceneBuilder moved = furnished_room(1.0F);
    move_away(moved, {1e4F, -1e4F, 1e4F});
    EXPECT_LT(relative_difference(solve(moved), usual), bound());
}

TEST_P(Invariance, NonFiniteValuesAreDroppedCountedAndGoneAfterwards) {
    const SceneBuilder b = furnished_room(1.0F);
    SolverSettings settings;
    settings.probabilities = *GetParam().bundles;
    settings.coarse = {64, 120};
    Solver solver(b.scene, b.mesh, settings);
    const auto iterate = [&](int count) {
        for (int i = 0; i < count; ++i) {
            solver.step({});
        }
    };
    iterate(20);  // amid a group: its beginning would write the radiance anew
    EXPECT_EQ(solver.non_finite(), 0U);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::uint32_t patch = 0; patch < b.mesh.patch_count(); ++patch) {
        const float bad = patch % 2 == 0 ? std::nanf("") : infinity;
        solver.store().write_radiance(patch, glm::vec4(bad, bad, 1.0F, 0.1F));
    }
    iterate(1);
    const auto check = [&] {
        for (const glm::vec4& e : solver.store().read_irradiance()) {
            ASSERT_TRUE(std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.z));
        }
    };
    check();
    iterate(27);
    check();
    EXPECT_GT(solver.non_finite(), 0U);
    const std::uint64_t dropped = solver.non_finite();
    iterate(64);
    check();
    EXPECT_EQ(solver.non_finite(), dropped) << "they came back";
}

INSTANTIATE_TEST_SUITE_P(Strategies, Invariance, testing::ValuesIn(strategies()), method_name);

}  // namespace
}  // namespace raybundle::invariance_test
