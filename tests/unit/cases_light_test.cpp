// SPDX-License-Identifier: Apache-2.0
// Lights as other programs write them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_files.h"
#include "gltf_builder.h"

namespace raybundle::test {
namespace {

using std::numbers::pi;

TEST(CasesSpot, HardSpotsAreDiscsOfEvenIntensity) {
    const Scene scene = load_gltf(case_path("spot/hard_edge.gltf"));
    EXPECT_NEAR(direct_illuminance(scene, {0, 0, 0}), 111.1, 0.1);
    EXPECT_NEAR(direct_illuminance(scene, {0.928, 0, 0}), 96.9, 0.1);
    EXPECT_EQ(direct_illuminance(scene, {1.639, 0, 0}), 0.0);
    const PlacedLight spot = place_light(scene, scene.punctual_lights[0]);
    EXPECT_NEAR(spot.flux().g, 2000.0 * pi * (1.0 - std::cos(0.4)), 0.1);
}

/// However narrow or wide, and where rounding puts one cone beyond the other.
TEST(CasesSpot, TheEdgeIsWhereTheOuterConeIs) {
    for (const double angle : {0.005, 0.02, 0.4, 1.0, 1.5}) {
        GltfBuilder builder = one_triangle();
        builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "spot"},
             {"intensity", 1000},
             {"spot", {{"innerConeAngle", angle}, {"outerConeAngle", angle}}}}};
        builder.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        const Scene scene = builder.load();
        const PlacedLight spot = place_light(scene, scene.punctual_lights[0]);
        const auto towards = [&](double from_axis) {
            return spot.towards({std::sin(from_axis), 0, -std::cos(from_axis)}).g;
        };
        EXPECT_NEAR(towards(0.0), 1000.0, 1e-6) << angle;
        EXPECT_NEAR(towards(0.9 * angle), 1000.0, 1e-6) << angle;
        EXPECT_EQ(towards(1.1 * angle), 0.0) << angle;
    }
}

}  // namespace
}  // namespace raybundle::test
