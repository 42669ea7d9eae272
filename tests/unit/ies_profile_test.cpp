// SPDX-License-Identifier: Apache-2.0
#include "scene/photometry/ies_profile.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "gltf_builder.h"

namespace raybundle::test {
namespace {

using std::numbers::pi;

/// A file of type C with these angles and candela(vertical, horizontal).
std::string type_c(int vertical_step, int last_vertical, int horizontal_step, int last_horizontal,
                   const std::function<double(double, double)>& candela,
                   const std::string& head = "IESNA:LM-63-2002\nTILT=NONE\n") {
    std::string angles;
    std::string values;
    int rows = 0;
    int columns = 0;
    for (int v = 0; v <= last_vertical; v += vertical_step, ++rows) {
        angles += fmt::format("{} ", v);
    }
    angles += "\n";
    for (int h = 0; h <= last_horizontal; h += horizontal_step, ++columns) {
        angles += fmt::format("{} ", h);
        for (int v = 0; v <= last_vertical; v += vertical_step) {
            values += fmt::format("{} ", candela(glm::radians(v * 1.0), glm::radians(h * 1.0)));
        }
        values += "\n";
    }
    return fmt::format("{}1 1000 1 {} {} 1 2 0 0 0\n1 1 10\n{}\n{}", head, rows, columns, angles,
                       values);
}

glm::dvec3 direction(double vertical, double horizontal) {
    const double v = glm::radians(vertical);
    const double h = glm::radians(horizontal);
    return {std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), -std::cos(v)};
}

TEST(IesProfile, FluxIsTheIntegralOfTheIntensity) {
    const auto even = parse_ies("f", type_c(90, 180, 90, 0, [](double, double) { return 100.0; }));
    EXPECT_NEAR(even.flux(), 400.0 * pi, 0.05);
    // A Lambert disc of 1000 lm, in steps of a degree.
    const auto disc = parse_ies("f", type_c(1, 90, 90, 0, [](double v, double) {
                                    return std::max(1000.0 / pi * std::cos(v), 0.0);
                                }));
    EXPECT_NEAR(disc.flux(), 1000.0, 0.3);
    const auto beam = parse_ies("f", type_c(5, 90, 15, 360, [](double v, double h) {
                                    return v < 1.5 ? 10.0 * (1.0 + std::cos(h)) : 0.0;
                                }));
    // The last ring falls to 0 from 85 to 90 degrees.
    const double ramp = pi / 36.0;
    EXPECT_NEAR(beam.flux(), 20.0 * pi * (1.0 - (1.0 - std::sin(pi / 2 - ramp)) / ramp), 0.2);
}

TEST(IesProfile, SymmetriesOfTypeCFillTheCircle) {
    const auto at = [](double, double h) { return 100.0 + 10.0 * glm::degrees(h); };
    const auto quadrant = parse_ies("f", type_c(90, 180, 45, 90, at));
    const auto half = parse_ies("f", type_c(90, 180, 45, 180, at));
    const auto full = parse_ies("f", type_c(90, 180, 45, 360, at));
    for (const double h : {10.0, 100.0, 190.0, 300.0}) {
        const glm::dvec3 d = direction(90.0, h);
        const double in_half = h > 180.0 ? 360.0 - h : h;
        const double in_quadrant = in_half > 90.0 ? 180.0 - in_half : in_half;
        EXPECT_NEAR(quadrant.candela(d), 100.0 + 10.0 * in_quadrant, 1e-6);
        EXPECT_NEAR(half.candela(d), 100.0 + 10.0 * in_half, 1e-6);
        EXPECT_NEAR(full.candela(d), 100.0 + 10.0 * h, 1e-6);
    }
}

TEST(IesProfile, Angles90To270AreSymmetricAboutTheirPlane) {
    const auto profile =
        parse_ies("f",
                  "IESNA:LM-63-1995\nTILT=NONE\n1 1 1 2 3 1 1 0 0 0\n1 1 1\n0 180\n"
                  "90 180 270\n10 10\n20 20\n30 30\n");
    EXPECT_NEAR(profile.candela(direction(90, 180)), 20.0, 1e-9);
    EXPECT_NEAR(profile.candela(direction(90, 0)), 20.0, 1e-9);
    EXPECT_NEAR(profile.candela(direction(90, 45)), 15.0, 1e-9);
    EXPECT_NEAR(profile.candela(direction(90, 315)), 25.0, 1e-9);
}

/// Type A turns about y, type B about x; both are aimed along -z.
TEST(IesProfile, TypesAAndBHaveTheirOwnPoles) {
    const auto file = [](int type) {
        return fmt::format(
            "IESNA:LM-63-2002\nTILT=NONE\n1 1 1 3 2 {} 1 0 0 0\n1 1 1\n-90 0 90\n0 90\n"
            "1 10 5\n2 20 8\n",
            type);
    };
    const auto a = parse_ies("f", file(3));
    const auto b = parse_ies("f", file(2));
    EXPECT_NEAR(a.candela({0, 0, -1}), 10.0, 1e-9);
    EXPECT_NEAR(b.candela({0, 0, -1}), 10.0, 1e-9);
    EXPECT_NEAR(a.candela({1, 0, 0}), 20.0, 1e-9);  // horizontal 90, vertical 0
    EXPECT_NEAR(a.candela({-1, 0, 0}), 20.0, 1e-9);
    EXPECT_NEAR(a.candela({0, 1, -1e-12}), 5.0, 1e-6);
    EXPECT_NEAR(b.candela({0, 1, 0}), 5.0, 1e-9);
    EXPECT_NEAR(b.candela({0, -1, 0}), 1.0, 1e-9);
    EXPECT_EQ(a.candela({0, 0, 1}), 0.0);
    EXPECT_EQ(b.candela({0, 0, 1}), 0.0);
}

/// Multiplier and ballast count always, the third factor until 1995.
TEST(IesProfile, FactorsCountAsTheirStandardSays) {
    const auto candela = [](const std::string& first) {
        return parse_ies("f", first + "TILT=NONE\n1 1 2 2 1 1 1 0 0 0\n0.5 0.25 1\n0 180\n0\n8 8\n")
            .candela({0, 0, -1});
    };
    EXPECT_DOUBLE_EQ(candela("IESNA:LM-63-2002\n"), 8.0);
    EXPECT_DOUBLE_EQ(candela("IES:LM-63-2019\r\n"), 8.0);
    EXPECT_DOUBLE_EQ(candela("IESNA:LM-63-1995\n"), 2.0);
    EXPECT_DOUBLE_EQ(candela("IESNA91\n"), 2.0);
    EXPECT_DOUBLE_EQ(candela("A file of 1986\n"), 2.0);
}

TEST(IesProfile, ErrorsNameTheLineAndTheReason) {
    const auto error = [](const std::string& text) -> std::string {
        try {
            (void)parse_ies("lamp.ies", text);
        } catch (const SceneError& e) {
            return e.what();
        }
        return "none";
    };
    const std::string head = "IESNA:LM-63-2002\nTILT=NONE\n";
    EXPECT_EQ(error(""), "lamp.ies: line 1: the file is empty");
    EXPECT_EQ(error("IESNA91\n"), "lamp.ies: line 2: there is no line that begins with TILT=");
    EXPECT_EQ(error(head + "1 1000 x"), "lamp.ies: line 3: the candela multiplier is not a number");
    EXPECT_EQ(error(head + "1 1000 1 2.5"),
              "lamp.ies: line 3: the number of vertical angles is 2.5, not an integer");
    EXPECT_EQ(error(head + "1 1000 1 1000000 1000000"),
              "lamp.ies: line 3: 1000000 x 1000000 values; the limit is 1048576");
    EXPECT_EQ(error(head + "1 1 1 2 1 1 1 0 0 0\n1 1 1\n90 0\n"),
              "lamp.ies: line 5: a vertical angle 0 is not above the one before it, 90");
    EXPECT_EQ(error(head + "1 1 1 2 1 1 1 0 0 0\n1 1 1\n0 90\n0\n1\n"),
              "lamp.ies: line 8: the file ends where a candela value should be");
    EXPECT_EQ(error(head + "1 1 1 2 1 1 1 0 0 0\n1 1 1\n0 90\n0\n0 0\n"),
              "lamp.ies: line 7: the luminaire gives no light");
    EXPECT_EQ(error(head + "1 1 1 2 1 1 1 0 0 0\n1 1 1\n10 90\n0\n1 1\n"),
              "lamp.ies: line 6: vertical angles of type C begin at 0 or 90 and are at least two");
}

/// A file whose only light is an IES profile.
GltfBuilder with_profile(const std::string& profile, const Json& use) {
    GltfBuilder builder;
    const int mesh = builder.add_triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    builder.add_node({{"mesh", mesh}});
    const std::vector<std::uint8_t> bytes(profile.begin(), profile.end());
    builder.json["extensionsRequired"] = {"EXT_lights_ies"};
    builder.json["extensions"]["EXT_lights_ies"]["lights"] = {
        {{"bufferView", builder.add_view(bytes)}, {"mimeType", "application/x-ies-lm-63"}}};
    builder.add_node({{"name", "downlight"}, {"extensions", {{"EXT_lights_ies", use}}}});
    return builder;
}

TEST(IesProfile, FilesBringThemAlong) {
    const std::string text = type_c(90, 180, 90, 0, [](double, double) { return 100.0; });
    const Scene scene =
        with_profile(text, {{"light", 0}, {"multiplier", 2}, {"color", {1, 0.5, 0.25}}}).load();
    ASSERT_EQ(scene.punctual_lights.size(), 1U);
    EXPECT_EQ(scene.punctual_lights[0].name, "downlight");
    const glm::dvec3 flux = place_light(scene, scene.punctual_lights[0]).flux();
    EXPECT_NEAR(flux.r, 800.0 * pi, 0.2);
    EXPECT_NEAR(flux.b, 200.0 * pi, 0.05);
    EXPECT_EQ(load_error(with_profile(text, {{"light", 1}})).reason(),
              "1 is out of range: the file has 1 lights");
    const SceneError broken = load_error(with_profile("TILT=NONE\n1", {{"light", 0}}));
    EXPECT_EQ(broken.json_path(), "extensions.EXT_lights_ies.lights[0]");
    EXPECT_EQ(broken.reason(), "line 2: the file ends where the lumens per lamp should be");
}

TEST(IesProfile, OptionGivesALightAFile) {
    const TemporaryFolder folder;
    SceneSettings settings;
    const std::string file =
        folder.write("even.ies", type_c(90, 180, 90, 0, [](double, double) { return 100.0; }));
    GltfBuilder builder;
    const int mesh = builder.add_triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    builder.add_node({{"mesh", mesh}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 7}, {"color", {1, 1, 1}}}};
    builder.add_node(
        {{"name", "desk=1"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    builder.json["nodes"].back()["name"] = "desk";
    settings.ies = {"desk=" + file};
    const Scene scene = builder.load(settings);
    ASSERT_EQ(scene.punctual_lights.size(), 1U);
    EXPECT_NEAR(place_light(scene, scene.punctual_lights[0]).flux().g, 400.0 * pi, 0.1);
    settings.ies = {"ceiling=" + file};
    try {
        (void)builder.load(settings);
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_EQ(error.reason(),
                  "--ies: there is no point light or spot 'ceiling'; punctual lights: 'desk'");
    }
}

}  // namespace
}  // namespace raybundle::test
