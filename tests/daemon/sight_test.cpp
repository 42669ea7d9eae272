// SPDX-License-Identifier: Apache-2.0
// What one viewer hides or cuts away is gone for him alone, and light is as with it. The sky is
// dimmed and switched like other lights.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"

namespace raybundle {
namespace {

constexpr int kBoard = 2;  ///< id of the board of pin_point.gltf

Json vector(double x, double y, double z) {
    return {{"x", x}, {"y", y}, {"z", z}};
}

/// A viewer who looks straight down onto a point of the floor.
class Onlooker {
  public:
    Onlooker(const Daemon& daemon, const Json& eye, const Json& target)
        : viewer_(daemon.port()), camera_{{"eye", eye}, {"target", target}} {
        welcome_ = viewer_.join("", 65, 65).at("welcome");
        look();
    }
    void look(double near = 0.0) {
        Json camera = camera_;
        camera["near"] = near;
        viewer_.request({{"setCamera", camera}});
    }
    Json request(const Json& message) { return viewer_.request(message); }
    [[nodiscard]] const Json& welcome() const { return welcome_; }
    Json probe() {
        return viewer_.request({{"probe", {{"pixel", {{"x", 32.5}, {"y", 32.5}}}}}})
            .at("probeResult");
    }
    double height() { return probe().at("position").value("y", 0.0); }
    double illuminance() { return probe().value("illuminance", 0.0); }
    /// Waits until the light is as it should be. False: only what hangs takes so long.
    bool becomes(const std::function<bool(double)>& right) {
        for (int i = 0; i < 600; ++i) {
            if (right(illuminance())) {
                return true;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        return false;
    }

  private:
    JsonViewer viewer_;
    Json camera_;
    Json welcome_;
};

class SightTest : public testing::Test {
  protected:
    SightTest() {
        // The board of 0.1 m hangs 1.2 m above the floor, below the lamp: the eye is above it.
        const Json between = {{"translation", vector(2.2, 1.2, 2.2)}, {"scale", vector(1, 1, 1)}};
        one_.request({{"moveObject", {{"object", kBoard}, {"transform", between}}}});
        one_.look();
        other_.look();
    }
    Daemon daemon_{std::string(RAYBUNDLE_ROOT) + "/tests/cases/places/pin_point.gltf"};
    Onlooker one_{daemon_, vector(2.7, 2.5, 2.6), vector(2.7, 0.0, 2.7)};
    Onlooker other_{daemon_, vector(2.7, 2.5, 2.6), vector(2.7, 0.0, 2.7)};
};

TEST_F(SightTest, WhatOneHidesIsThereForOthersAndForTheLight) {
    ASSERT_GT(one_.height(), 1.0);
    ASSERT_TRUE(one_.request({{"setHidden", {{"objects", {kBoard}}}}}).contains("ok"));
    EXPECT_NEAR(one_.height(), 0.0, 1e-3);
    EXPECT_GT(other_.height(), 1.0);
    EXPECT_TRUE(one_.becomes([](double lx) { return lx < 15.0; }))  // open it has 40 lx
        << "the floor lies in the board's shadow: " << one_.illuminance();
    ASSERT_TRUE(one_.request({{"setHidden", {{"objects", Json::array()}}}}).contains("ok"));
    EXPECT_GT(one_.height(), 1.0);
    EXPECT_EQ(one_.request({{"setHidden", {{"objects", {99}}}}}).at("error").at("code"),
              "NOT_FOUND");
}

TEST_F(SightTest, WhatIsCutAwayIsThereForOthers) {
    ASSERT_GT(one_.height(), 1.0);
    one_.look(1.6);
    EXPECT_NEAR(one_.height(), 0.0, 1e-3);
    EXPECT_GT(other_.height(), 1.0);
    one_.look();
    EXPECT_GT(one_.height(), 1.0);
}

/// A floor below a uniform sky of 1000 cd/m² has pi times as many lux.
TEST(SkyLight, IsListedDimmedAndSwitchedLikeOthers) {
    const Daemon daemon(std::string(RAYBUNDLE_ROOT) + "/tests/cases/sky/floor.gltf",
                        {"--sky", "1000"});
    Onlooker onlooker(daemon, vector(0.0, 2.0, 0.1), vector(0.0, 0.0, 0.0));
    const Json lights = onlooker.welcome().at("scene").at("lights");
    const Json& sky = lights.back();
    EXPECT_EQ(sky.at("name"), "sky");
    EXPECT_EQ(sky.at("unit"), "CD_PER_M2");
    EXPECT_FLOAT_EQ(sky.at("intensity").get<float>(), 1000.0F);
    const auto set = [&](const Json& fields) {
        Json body = fields;
        body["light"] = sky.at("id");
        return onlooker.request({{"setLight", body}});
    };
    const auto near = [](double right) {
        return [right](double lx) { return std::abs(lx - right) <= 0.03 * right + 1.0; };
    };
    EXPECT_TRUE(onlooker.becomes(near(1000.0 * std::numbers::pi))) << onlooker.illuminance();
    ASSERT_TRUE(set({{"intensity", 500.0}}).contains("sceneChanged"));
    EXPECT_TRUE(onlooker.becomes(near(500.0 * std::numbers::pi))) << onlooker.illuminance();
    ASSERT_TRUE(set({{"on", false}}).contains("sceneChanged"));
    EXPECT_TRUE(onlooker.becomes(near(0.0))) << onlooker.illuminance();
    ASSERT_TRUE(set({{"on", true}}).contains("sceneChanged"));
    EXPECT_TRUE(onlooker.becomes(near(500.0 * std::numbers::pi))) << onlooker.illuminance();
}

}  // namespace
}  // namespace raybundle
