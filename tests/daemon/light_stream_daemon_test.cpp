// SPDX-License-Identifier: Apache-2.0
// The light stream of a running server: snapshot, changes, who comes late, who reads nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "daemon.h"
#include "gpu/egl_context.h"
#include "json_viewer.h"
#include "light_viewer.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/mesh/patch_mesh.h"
#include "transport/solver.h"
#include "view/light_values.h"
#include "walkthrough/live/live_geometry.h"
#include "walkthrough/quantise.h"
#include "walkthrough/vertex_light.h"

namespace raybundle {
namespace {

/// What the GPU packs is what the CPU makes of the patches, to quantisation and half floats.
TEST(LightValues, AreThoseOfThePatches) {
    const EglContext context = create_egl_context();
    Scene scene = load_gltf(scene_file("cornell_box.gltf"));
    const PatchMesh mesh = tessellate(scene);
    Solver solver(scene, mesh);
    for (int i = 0; i < 16; ++i) {
        solver.step({});
    }
    const LiveGeometry made = make_live_geometry(scene, mesh, 64.0F, shader_files());
    LightValues light(solver.scene(), solver.store(), made.sources, made.unit);
    light.request();
    const std::span<const std::uint32_t> values = light.take();
    ASSERT_EQ(values.size(), made.sources.size());
    const VertexLight expected =
        light_at_vertices(mesh, world_positions(scene, mesh), solver.store().read_irradiance());
    float brightest = 0.0F;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::uint32_t vertex = made.sources[i] / 2;
        const glm::vec3 own = std::numbers::inv_pi_v<float> / made.unit *
                              (made.sources[i] % 2 == 1 ? expected.back : expected.front)[vertex];
        const float most = std::max({own.r, own.g, own.b});
        const glm::vec3 step = glm::abs(from_rgb9e5(values[i]) - own);
        EXPECT_LE(std::max({step.r, step.g, step.b}), most * 0.005F + 1e-5F) << i;
        brightest = std::max(brightest, most);
    }
    EXPECT_GT(brightest, 1.0F);
    // Lamps come after the vertices.
    const std::vector<std::uint32_t> lamps = emission_values(made, mesh.emission);
    EXPECT_EQ(values.size() + lamps.size(), made.blocks.back().first + made.blocks.back().count);
    EXPECT_EQ(std::count_if(lamps.begin(), lamps.end(), [](auto value) { return value != 0; }), 1);
}

class LightStreamTest : public testing::Test {
  protected:
    LightStreamTest() : daemon_(scene_file("cornell_box.gltf"), {"--journal", "none"}) {}

    /// Waits for the light after a change, and then until nothing has come for so many frames.
    static void settle(LightViewer& viewer, std::uint32_t epoch) {
        ASSERT_TRUE(viewer.read_until([&] { return viewer.complete() && viewer.epoch >= epoch; }));
    }

    Daemon daemon_;
};

TEST_F(LightStreamTest, GeometryIsNamedByItsContentsAndKept) {
    LightViewer viewer(daemon_.port());
    const Json welcome = viewer.join();
    ASSERT_TRUE(welcome.contains("welcome")) << welcome;
    EXPECT_EQ(welcome["welcome"]["light"], true);
    ASSERT_TRUE(viewer.read_until([&] { return viewer.complete(); }));
    const std::string url = viewer.scene["url"];
    const std::string answer =
        http_exchange(daemon_.port(),
                      "GET " + url + "scene.json HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
    EXPECT_TRUE(has(answer, "200 OK")) << answer.substr(0, 300);
    EXPECT_TRUE(has(answer, "max-age=31536000, immutable"));
    EXPECT_TRUE(has(answer, "raybundle-walkthrough"));
    EXPECT_TRUE(has(answer, "\"bytes\":" + std::to_string(4 * viewer.values.size())));
}

TEST_F(LightStreamTest, ChangesOfALightAndAnObjectArriveAndWhoComesLateHasTheSame) {
    LightViewer viewer(daemon_.port());
    const Json welcome = viewer.join();
    settle(viewer, 0);
    const double before = viewer.mean();
    EXPECT_GT(before, 0.0);
    const Json light = welcome["welcome"]["scene"]["lights"][0];
    viewer.request(
        {{"setLight", {{"light", 1}, {"intensity", light["intensity"].get<double>() / 2}}}});
    // What does not fit into one message comes with the next ones.
    EXPECT_TRUE(viewer.read_until([&] {
        return viewer.epoch >= 1 && std::abs(viewer.mean() / before - 0.5) < 0.02;
    })) << viewer.mean() / before;
    viewer.request({{"moveObject",
                     {{"object", kShortBox},
                      {"transform", {{"translation", {{"x", 0.4}, {"y", 0}, {"z", 0}}}}}}}});
    settle(viewer, 2);
    viewer.request(
        {{"setMaterial", {{"material", 1}, {"baseColour", {{"x", 0.1}, {"y", 0.2}, {"z", 0.3}}}}}});
    settle(viewer, 3);
    ASSERT_EQ(viewer.materials.size(), 1U);
    EXPECT_EQ(viewer.materials[0]["material"], 1);
    LightViewer late(daemon_.port());
    late.join();
    settle(late, 3);
    ASSERT_EQ(late.materials.size(), 1U);
    EXPECT_EQ(late.materials[0], viewer.materials[0]);
    EXPECT_EQ(late.scene["url"], viewer.scene["url"]);
    EXPECT_TRUE(late.read_until([&] { return std::abs(late.mean() / viewer.mean() - 1.0) < 0.02; }))
        << late.mean() / viewer.mean();
}

TEST_F(LightStreamTest, WhoAcknowledgesNothingGetsAWindowAndHarmsNobody) {
    LightViewer silent(daemon_.port());
    silent.acknowledges = false;
    silent.join();
    LightViewer viewer(daemon_.port());
    viewer.join();
    settle(viewer, 0);
    std::uint32_t epoch = 0;
    for (const double intensity : {100.0, 2000.0, 50.0, 1000.0, 500.0, 1500.0}) {
        viewer.request({{"setLight", {{"light", 1}, {"intensity", intensity}}}});
        settle(viewer, ++epoch);
    }
    // All that has been sent to it comes before the answer to a request.
    silent.request({{"ping", Json::object()}});
    const std::size_t first = silent.bytes;
    EXPECT_GT(first, 0U);
    EXPECT_LE(first, 32768U);
    silent.acknowledges = true;
    silent.send({{"ackLight", {{"light", silent.last}}}});
    EXPECT_TRUE(silent.read_until([&] {
        return silent.complete() && silent.epoch >= epoch &&
               std::abs(silent.mean() / viewer.mean() - 1.0) < 0.03;
    })) << silent.mean() / viewer.mean();
}

TEST_F(LightStreamTest, RefusesWhatMakesNoSense) {
    LightViewer plain(daemon_.port());
    const Json welcome = plain.join(false);
    EXPECT_FALSE(welcome["welcome"].contains("light"));
    const auto code = [](const Json& answer) { return answer["error"].value("code", ""); };
    EXPECT_EQ(code(plain.request({{"ackLight", {{"light", 1}}}})), "INVALID_ARGUMENT");
    EXPECT_EQ(code(plain.request({{"setDrawing", {{"here", true}}}})), "INVALID_ARGUMENT");
    EXPECT_EQ(plain.messages, 0U);
    LightViewer viewer(daemon_.port());
    viewer.join();
    EXPECT_EQ(code(viewer.request({{"ackLight", Json::object()}})), "INVALID_ARGUMENT");
    // A number that was never sent is nobody's.
    EXPECT_TRUE(viewer.request({{"ackLight", {{"light", 4000000000U}}}}).contains("ok"));
    EXPECT_TRUE(viewer.request({{"setDrawing", {{"here", true}}}}).contains("ok"));
    settle(viewer, 0);
}

}  // namespace
}  // namespace raybundle
