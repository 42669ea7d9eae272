// SPDX-License-Identifier: Apache-2.0
// Glare of luminaires that are added over the wire, in a space without surfaces, against CIE 117's
// formula.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>

#include "daemon.h"
#include "json_viewer.h"
#include "test_folder.h"

namespace raybundle::added_glare_test {
namespace {

Json vec(double x, double y, double z) {
    return {{"x", x}, {"y", y}, {"z", z}};
}

/// Two black triangles of a metre, 10 m from the origin to each side: they give the scene its size.
const std::string specks =
    "data:application/octet-stream;base64,AAAgwQAAIMEAACDBAAAQwQAAIMEAACDBAAAgwQAAIME"
    "AABDBAAAgQQAAIEEAACBBAAAgQQAAIEEAADBBAAAwQQAAIEEAACBB";

Json open_space() {
    const auto view = [](int offset) {
        return Json{{"bufferView", 0},
                    {"byteOffset", offset},
                    {"componentType", 5126},
                    {"count", 3},
                    {"type", "VEC3"}};
    };
    Json low = view(0);
    low.update({{"min", {-10.0, -10.0, -10.0}}, {"max", {-9.0, -10.0, -9.0}}});
    Json high = view(36);
    high.update({{"min", {10.0, 10.0, 10.0}}, {"max", {11.0, 10.0, 11.0}}});
    const auto speck = [](int accessor) {
        return Json{{"attributes", {{"POSITION", accessor}}}, {"material", 0}};
    };
    return {
        {"asset", {{"version", "2.0"}}},
        {"scenes", {{{"nodes", {0}}}}},
        {"scene", 0},
        {"nodes", {{{"mesh", 0}, {"name", "specks"}}}},
        {"meshes", {{{"primitives", {speck(0), speck(1)}}}}},
        {"materials", {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.0, 0.0, 0.0, 1.0}}}}}}},
        {"accessors", {low, high}},
        {"bufferViews", {{{"buffer", 0}, {"byteLength", 72}}}},
        {"buffers", {{{"byteLength", 72}, {"uri", specks}}}}};
}

/// A luminaire of 0.3 m x 0.3 m and 450 cd to all sides is one of 5000 cd/m² where it faces the
/// eye. From 3 m, 20 degrees above the line of sight (p = 2.146), before a sky of 40 cd/m²:
/// UGR = 8 log10(0.25/40 5000² 0.01/2.146²) = 20.245; two that are alike have 8 log10 2 more.
TEST(AddedGlare, IsThatWorkedByHandFromTheFilesOpening) {
    TestFolder folder;
    folder.write("space.gltf", open_space().dump());
    std::filesystem::create_directories(folder.path("photometry"));
    folder.write("photometry/panel.ies",
                 "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0.3 0.3 0\n1 1 10\n0 90 180\n0\n"
                 "450 450 450\n");
    Daemon daemon(folder.path("space.gltf"), {"--scenes", folder.path(), "--sky", "40"});
    JsonViewer editor(daemon.port());
    editor.join("");
    const auto ugr = [&] {
        const Json answer = editor.request({{"measure",
                                             {{"quantity", "UGR"},
                                              {"points", {{{"position", vec(0, 0, 0)}}}},
                                              {"direction", vec(0, 0, -1)},
                                              {"relativeError", 0.02}}}});
        EXPECT_TRUE(answer.contains("measured")) << answer;
        return answer.at("measured").at("points").at(0);
    };
    /// 20 degrees from the line of sight, so many from the vertical.
    const auto add_towards = [&](double tau) {
        const double s = glm::radians(20.0);
        const double t = glm::radians(tau);
        const glm::dvec3 towards(std::sin(s) * std::sin(t), std::sin(s) * std::cos(t),
                                 -std::cos(s));
        const Json added =
            editor.request({{"addLuminaire",
                             {{"photometry", "panel.ies"},
                              {"position", vec(3.0 * towards.x, 3.0 * towards.y, 3.0 * towards.z)},
                              {"aim", vec(-towards.x, -towards.y, -towards.z)},
                              {"name", "panel " + std::to_string(static_cast<int>(tau))}}}});
        EXPECT_TRUE(added.contains("sceneChanged")) << added;
        return added.at("sceneChanged").at("addLuminaire").at("light");
    };
    EXPECT_EQ(ugr().at("glare").at("state"), "NO_SOURCE");
    const Json first = add_towards(0.0);
    const Json one = ugr();
    ASSERT_EQ(one.at("glare").at("state"), "RATED") << one;
    EXPECT_NEAR(one.at("value").get<double>(), 20.245, 0.05);
    ASSERT_EQ(one.at("glare").at("sources").size(), 1U);
    const Json source = one.at("glare").at("sources").at(0);
    EXPECT_EQ(source.at("light"), first);
    EXPECT_EQ(source.at("name"), "panel 0");
    EXPECT_NEAR(source.at("share").get<double>(), 1.0, 1e-6);
    EXPECT_NEAR(source.at("luminance").get<double>(), 5000.0, 10.0);
    EXPECT_NEAR(source.at("solidAngle").get<double>(), 0.01, 1e-4);
    EXPECT_NEAR(source.at("positionIndex").get<double>(), 2.146, 2e-3);

    const Json left = add_towards(-50.0);
    add_towards(50.0);
    editor.request({{"removeLight", {{"light", first}}}});
    const Json both = ugr();
    ASSERT_EQ(both.at("glare").at("sources").size(), 2U) << both;
    for (const Json& one_of_both : both.at("glare").at("sources")) {
        EXPECT_NEAR(one_of_both.at("share").get<double>(), 0.5, 0.02);
    }
    // Dimmed to half, one of them has a quarter of the other's L² omega.
    editor.request({{"setLight", {{"light", left}, {"dim", 0.5}}}});
    const Json dimmed = ugr();
    EXPECT_NEAR(dimmed.at("value").get<double>() - both.at("value").get<double>(),
                8.0 * std::log10(1.25 / 2.0), 0.05);
    EXPECT_NEAR(dimmed.at("glare").at("sources").at(0).at("share").get<double>(), 0.8, 0.02);
    EXPECT_EQ(dimmed.at("glare").at("sources").at(1).at("light"), left);
}

}  // namespace
}  // namespace raybundle::added_glare_test
