// SPDX-License-Identifier: Apache-2.0
// Every light that `welcome` lists: in which units, and that it can be changed.
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "daemon.h"
#include "json_viewer.h"
#include "test_folder.h"

namespace raybundle {
namespace {

using std::numbers::pi;

std::string case_file(const std::string& name) {
    return std::string(RAYBUNDLE_ROOT "/tests/cases/") + name;
}

const std::string lamps = case_file("lights/lamps.gltf");

Json lights_of(const Json& welcome) {
    return welcome.at("welcome").at("scene").at("lights");
}

Json light_named(const Json& lights, const std::string& name) {
    for (const Json& light : lights) {
        if (light.at("name") == name) {
            return light;
        }
    }
    return {};
}

void expect_figures(const Json& light, const std::string& unit, double intensity, double flux) {
    EXPECT_EQ(light.at("unit"), unit) << light;
    EXPECT_NEAR(light.at("intensity").get<double>(), intensity, 1e-3 * intensity) << light;
    EXPECT_NEAR(light.value("flux", 0.0), flux, 1e-3 * flux) << light;
}

TEST(CasesLights, AreListedInTheUnitsThatPeopleKnow) {
    Daemon daemon(lamps);
    JsonViewer viewer(daemon.port());
    const Json lights = lights_of(viewer.join());
    ASSERT_EQ(lights.size(), 5U);
    expect_figures(light_named(lights, "panel"), "CD_PER_M2", 100.0, 100.0 * pi);
    expect_figures(light_named(lights, "bulb"), "CD", 100.0, 400.0 * pi);
    expect_figures(light_named(lights, "sun"), "LX", 50.0, 0.0);
    const Json luminaire = light_named(lights, "downlight");
    expect_figures(luminaire, "LM", 3000.0 * pi, 3000.0 * pi);
    EXPECT_NEAR(luminaire.at("peak").get<double>(), 3000.0, 1.0);
    EXPECT_EQ(luminaire.at("watts"), 10.0);
    EXPECT_FALSE(light_named(lights, "sun").contains("peak"));
}

Json set_light(const Json& light, const Json& fields) {
    Json body = fields;
    body["light"] = light.at("id");
    return {{"setLight", body}};
}

TEST(CasesLights, CanAllBeChangedTakenBackAndKept) {
    const TestFolder folder;
    Json changed;
    {
        Daemon daemon(lamps, {"--journal", folder.path("session.db")});
        JsonViewer viewer(daemon.port());
        const Json lights = lights_of(viewer.join());
        for (const Json& light : lights) {
            const double half = 0.5 * light.at("intensity").get<double>();
            const Json off = viewer.request(set_light(light, {{"on", false}}));
            ASSERT_TRUE(off.contains("sceneChanged")) << off;
            const Json dim = viewer.request(set_light(
                light, {{"intensity", half}, {"colour", {{"x", 2.0}, {"y", 0.5}, {"z", 0.1}}}}));
            ASSERT_TRUE(dim.contains("sceneChanged")) << dim;
        }
        JsonViewer other(daemon.port());
        changed = lights_of(other.join());
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const Json& now = changed.at(i);
            EXPECT_EQ(now.at("on"), false);
            EXPECT_NEAR(now.at("intensity").get<double>(),
                        0.5 * lights.at(i).at("intensity").get<double>(), 1e-2)
                << now;
            EXPECT_GT(now.at("colour").at("x").get<double>(), 2.0);
            EXPECT_EQ(now.at("loadedIntensity"), lights.at(i).at("loadedIntensity"));
        }
        EXPECT_EQ(
            viewer.request({{"setLight", {{"light", 6}, {"on", true}}}}).at("error").at("code"),
            "NOT_FOUND");
        EXPECT_EQ(daemon.end(), 0);
    }
    Daemon daemon(lamps, {"--journal", folder.path("session.db")});
    JsonViewer viewer(daemon.port());
    EXPECT_EQ(lights_of(viewer.join()), changed);
    EXPECT_TRUE(viewer.request({{"undo", {{"epoch", 0}}}}).contains("ok"));
    JsonViewer other(daemon.port());
    for (const Json& light : lights_of(other.join())) {
        EXPECT_EQ(light.at("on"), true);
        EXPECT_FLOAT_EQ(light.at("intensity").get<float>(),
                        light.at("loadedIntensity").get<float>());
    }
}

/// The luminaire alone, 2 m above the floor: 1000 cd at 3140 lm, E = I / h².
TEST(CasesLights, LightIsRightAfterTheyHaveBeenChanged) {
    Daemon daemon(lamps);
    JsonViewer viewer(daemon.port());
    const Json lights = lights_of(viewer.join("", 65, 65));
    viewer.request({{"setCamera",
                     {{"eye", {{"x", 0.0}, {"y", 1.9}, {"z", 2.0}}},
                      {"target", {{"x", 0.0}, {"y", 0.0}, {"z", 2.0}}},
                      {"up", {{"x", 0.0}, {"y", 0.0}, {"z", -1.0}}}}}});
    const auto below = [&] {
        return viewer.request({{"probe", {{"pixel", {{"x", 32.5}, {"y", 32.5}}}}}})
            .at("probeResult")
            .at("illuminance")
            .get<double>();
    };
    EXPECT_GT(below(), 750.0);
    for (const Json& light : lights) {
        if (light.at("name") != "downlight") {
            viewer.request(set_light(light, {{"on", false}}));
        }
    }
    EXPECT_NEAR(below(), 750.0, 7.5);
    const Json luminaire = light_named(lights, "downlight");
    viewer.request(set_light(luminaire, {{"intensity", 1000.0 * pi}}));
    EXPECT_NEAR(below(), 250.0, 2.5);
    viewer.request(set_light(luminaire, {{"on", false}}));
    EXPECT_NEAR(below(), 0.0, 1e-3);
    viewer.request(set_light(luminaire, {{"on", true}}));
    EXPECT_NEAR(below(), 250.0, 2.5);
}

/// Where the only lamp goes out a picture does not state an error of nothing, and is not lifted.
TEST(CasesDark, SaysThatNoLightArrivesAndStaysDark) {
    Daemon daemon(case_file("places/pin_point.gltf"));
    JsonViewer viewer(daemon.port());
    const Json light = viewer.join("", 65, 65).at("welcome").at("scene").at("lights").at(0);
    // Frames say the same as the message that comes beside them.
    const auto header_that_says = [&](const std::string& one, const std::string& other) {
        const Json said = viewer.next([&](const Json& message) {
            return message.contains("solution") && message.at("solution").contains(one);
        });
        EXPECT_TRUE(said.contains("solution")) << one;
        EXPECT_FALSE(said.value("solution", Json::object()).contains(other)) << said;
        const Json header =
            viewer.next_frame([&](const Json& frame) { return frame.contains(one); });
        EXPECT_FALSE(header.contains(other)) << header;
        return header;
    };
    const Json lit = header_that_says("relativeError", "darkerThan");
    ASSERT_TRUE(viewer.request(set_light(light, {{"on", false}})).contains("sceneChanged"));
    const Json dark = header_that_says("darkerThan", "relativeError");
    EXPECT_GT(dark.value("darkerThan", 0.0), 0.0);
    EXPECT_LT(dark.value("darkerThan", 0.0), 1.0);  // cd/m²; some 3 before
    EXPECT_LT(dark.value("exposure", 99.0), lit.value("exposure", 0.0) + 4.0);
    ASSERT_TRUE(viewer.request(set_light(light, {{"on", true}})).contains("sceneChanged"));
    header_that_says("relativeError", "darkerThan");
}

/// A viewer of the room of pin_point.gltf, whose lamp has no extent.
class CasesPins : public testing::Test {
  protected:
    CasesPins() {
        viewer_.join("", 65, 65);
        viewer_.request({{"setTarget", {{"relativeError", 0.05}}}});
    }

    Json along(const Json& origin, const Json& direction) {
        return viewer_
            .request({{"probe", {{"ray", {{"origin", origin}, {"direction", direction}}}}}})
            .at("probeResult");
    }
    void look_at(const Json& target) {
        viewer_.request(
            {{"setCamera", {{"eye", {{"x", 2.5}, {"y", 1.6}, {"z", 1.5}}}, {"target", target}}}});
    }
    Json probe() {
        return viewer_.request({{"probe", {{"pixel", {{"x", 32.5}, {"y", 32.5}}}}}})
            .at("probeResult");
    }
    /// Until the error of the picture is below the target.
    void wait_for_target() {
        viewer_.next([](const Json& message) {
            return message.contains("solution") &&
                   message["solution"].value("relativeError", 1.0) < 0.05;
        });
    }
    Json pin_at(const Json& probe) {
        return viewer_
            .request({{"addPin",
                       {{"text", "here"},
                        {"position", probe.at("position")},
                        {"patch", probe.at("patch")}}}})
            .at("pinChanged");
    }

    Daemon daemon_{case_file("places/pin_point.gltf")};
    JsonViewer viewer_{daemon_.port()};
    const Json wall_{{"x", 2.5}, {"y", 1.5}, {"z", 0.0}};
    const Json floor_{{"x", 2.5}, {"y", 0.0}, {"z", 3.0}};
};

TEST_F(CasesPins, OutOfSightSaysWhatAProbeThereSays) {
    look_at(wall_);
    wait_for_target();
    const Json probed = probe();
    ASSERT_EQ(probed.at("hit"), true);
    const auto exact = probed.at("illuminance").get<double>();
    EXPECT_GT(exact, 25.0);  // by the lamp alone
    look_at(floor_);
    const Json pin = pin_at(probed);
    EXPECT_NEAR(pin.at("illuminance").get<double>(), exact, 0.05 * exact);

    // So does a line to the point; one that leaves the room ends nowhere.
    const Json& end = probed.at("position");
    const Json met = along({{"x", end.at("x")}, {"y", end.at("y")}, {"z", 0.4}}, {{"z", -0.01}});
    ASSERT_EQ(met.at("hit"), true);
    EXPECT_EQ(met.at("object"), probed.at("object"));
    EXPECT_NEAR(met.at("position").at("x").get<double>(), end.at("x").get<double>(), 2e-3);
    EXPECT_NEAR(met.at("position").at("z").get<double>(), 0.0, 2e-3);
    for (const char* quantity : {"illuminance", "luminance"}) {
        const auto shown = probed.at(quantity).get<double>();
        EXPECT_NEAR(met.at(quantity).get<double>(), shown, 0.05 * shown) << quantity;
    }
    EXPECT_EQ(along({{"x", 2.5}, {"y", 500.0}, {"z", 0.0}}, {{"y", 3.0}}).at("hit"), false);
}

TEST_F(CasesPins, ChangeHoldsTheLampsOwnLight) {
    look_at(floor_);
    const Json pin = pin_at(probe());
    viewer_.request({{"moveObject",
                      {{"object", 2},
                       {"transform", {{"translation", {{"x", 2.2}, {"y", 1.2}, {"z", 2.2}}}}}}}});
    const Json changed = viewer_.next([&](const Json& message) {
        return message.contains("pinChanged") && message.at("pinChanged").contains("change");
    });
    ASSERT_TRUE(changed.contains("pinChanged"));
    EXPECT_LT(changed.at("pinChanged").at("change").get<double>(), -0.7);
}

/// Beyond the limits a viewport has the largest size of its shape, and its viewer is told.
TEST(CasesViewport, LargerThanTheLimitsIsServedSmaller) {
    Daemon daemon(lamps);
    JsonViewer viewer(daemon.port());
    const Json welcome = viewer.join("", 32768, 64).at("welcome");
    EXPECT_EQ(welcome.at("viewport"), Json({{"width", 8192}, {"height", 16}}));
    EXPECT_EQ(welcome.at("limits").at("maxViewportEdge"), 8192);
    EXPECT_EQ(welcome.at("limits").at("maxViewportPixels"), 3840 * 2160);
    const Json tall = viewer.request({{"setViewport", {{"width", 64}, {"height", 16384}}}});
    EXPECT_EQ(tall.at("ok").at("viewport"), Json({{"width", 32}, {"height", 8192}}));
    const Json plain = viewer.request({{"setViewport", {{"width", 64}, {"height", 48}}}});
    EXPECT_FALSE(plain.at("ok").contains("viewport"));
    EXPECT_EQ(viewer.next_frame([](const Json& f) { return f.at("width") == 64; }).at("height"),
              48);
}

}  // namespace
}  // namespace raybundle
