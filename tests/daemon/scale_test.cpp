// SPDX-License-Identifier: Apache-2.0
// Objects that grow, shrink and go far away by the wire.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"

namespace raybundle {
namespace {

constexpr int kBox = 2;  ///< id of the box of pin_point.gltf

Json xyz(double x, double y, double z) {
    return {{"x", x}, {"y", y}, {"z", z}};
}

Json placed(const Json& translation, const Json& scale) {
    return {{"moveObject",
             {{"object", kBox}, {"transform", {{"translation", translation}, {"scale", scale}}}}}};
}

/// The room of pin_point.gltf: a lamp without extent above the floor, and a board of 1 x 0.1 x 1 m
/// that can be put between both.
class ScaleTest : public testing::Test {
  protected:
    ScaleTest() {
        viewer_.join("", 65, 65);
        viewer_.request(
            {{"setCamera", {{"eye", xyz(2.5, 1.0, 1.5)}, {"target", xyz(2.5, 0.0, 3.0)}}}});
    }

    /// Illuminance of the floor below the lamp, lx.
    double below() {
        return viewer_.request({{"probe", {{"pixel", {{"x", 32.5}, {"y", 32.5}}}}}})
            .at("probeResult")
            .at("illuminance")
            .get<double>();
    }

    /// Scales the board where it is between lamp and floor.
    Json scale(double factor) {
        return viewer_.request(placed(between_, xyz(factor, factor, factor)));
    }

    /// Waits until the light is as it should be. False: only what hangs takes so long.
    bool becomes(const std::function<bool(double)>& right) {
        for (int i = 0; i < 600; ++i) {
            if (right(below())) {
                return true;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        return false;
    }

    Daemon daemon_{std::string(RAYBUNDLE_ROOT) + "/tests/cases/places/pin_point.gltf"};
    JsonViewer viewer_{daemon_.port()};
    const Json between_ = xyz(2.2, 1.2, 2.2);
};

TEST_F(ScaleTest, LightFollowsAnObjectThatShrinksAndGrows) {
    const double open = below();
    EXPECT_GT(open, 39.0);  // by the lamp alone: 300 cd at 2.746 m
    const auto bright = [&](double lx) { return lx > 0.85 * open && lx < 1.15 * open; };
    const auto dark = [&](double lx) { return lx >= 0.0 && lx < 0.3 * open; };
    for (const double factor : {1.0, 1e-3, 1e-2, 1.0, 10.0, 1e3, 1e-3, 1e3, 1.0}) {
        const Json answer = scale(factor);
        ASSERT_TRUE(answer.contains("sceneChanged")) << factor << answer;
        EXPECT_NEAR(answer.at("sceneChanged")
                        .at("moveObject")
                        .at("transform")
                        .at("scale")
                        .at("y")
                        .get<double>(),
                    factor, 1e-6 * factor);
        EXPECT_TRUE(factor < 1.0 ? becomes(bright) : becomes(dark)) << factor << ": " << below();
    }
    ASSERT_TRUE(viewer_.request({{"undo", {{"epoch", 0}}}}).contains("ok"));
    EXPECT_TRUE(becomes(bright)) << "taken back: " << below() << " lx, before " << open;
}

TEST_F(ScaleTest, AMoveBeyondTheLimitsIsAnErrorAndChangesNothing) {
    ASSERT_TRUE(scale(1.0).contains("sceneChanged"));
    JsonViewer before(daemon_.port());
    const Json objects = before.join().at("welcome").at("scene").at("objects");
    struct Beyond {
        Json request;
        const char* field;
    };
    const Json one = xyz(1, 1, 1);
    for (const Beyond& beyond : {
             Beyond{placed(xyz(2e5, 0, 0), one), "moveObject.transform.translation"},
             Beyond{placed(xyz(0, 0, -1e8), one), "moveObject.transform.translation"},
             Beyond{placed(between_, xyz(1e6, 1e6, 1e6)), "moveObject.transform."},
             Beyond{placed(between_, xyz(1, 1, 4e5)), "moveObject.transform."},
             Beyond{placed(between_, xyz(1, 0, 1)), "moveObject.transform.scale"},
         }) {
        const Json error = viewer_.request(beyond.request).at("error");
        EXPECT_EQ(error.at("code"), "INVALID_ARGUMENT");
        const auto text = error.at("message").get<std::string>();
        EXPECT_TRUE(text.starts_with(beyond.field)) << text;
    }
    const std::string limit =
        viewer_.request(placed(xyz(2e5, 0, 0), one)).at("error").at("message");
    EXPECT_TRUE(has(limit, "the limit is 1677")) << limit;
    JsonViewer after(daemon_.port());
    const Json welcome = after.join().at("welcome");
    EXPECT_EQ(welcome.at("epoch"), 1);
    EXPECT_EQ(welcome.at("scene").at("objects"), objects);
    EXPECT_TRUE(scale(2.0).contains("sceneChanged")) << "the next change is made";
}

}  // namespace
}  // namespace raybundle
