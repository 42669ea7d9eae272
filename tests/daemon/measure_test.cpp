// SPDX-License-Identifier: Apache-2.0
// Light at points in the air, measured for viewers: once, and kept while the scene changes.
#include <gtest/gtest.h>

#include <algorithm>

#include "daemon.h"
#include "json_viewer.h"

namespace raybundle {
namespace {

Json vec(double x, double y, double z) {
    return {{"x", x}, {"y", y}, {"z", z}};
}

Json plane() {
    return {{"origin", vec(0.5, 0.75, 0.5)}, {"u", vec(4.5, 0, 0)}, {"v", vec(0, 0, 4.5)}};
}

Json horizontal(int columns, int rows, bool keep, double error) {
    return {{"measure",
             {{"quantity", "HORIZONTAL"},
              {"area", plane()},
              {"columns", columns},
              {"rows", rows},
              {"keep", keep},
              {"relativeError", error}}}};
}

class MeasureTest : public testing::Test {
  protected:
    MeasureTest()
        : daemon_(scene_file("cornell_box.gltf"), {"--journal", "none"}), viewer_(daemon_.port()) {
        viewer_.join();
    }

    /// The kept measurement as it is after a change, once it is as exact as asked.
    Json after(std::uint32_t epoch, double error) {
        return viewer_
            .next([&](const Json& message) {
                return message.contains("measured") && message["measured"]["epoch"] == epoch &&
                       message["measured"].value("relativeError", 0.0) <= error;
            })
            .at("measured");
    }
    /// Intervals of the same points at the same time, by other paths: nearly all overlap.
    void expect_same(const Json& one, const Json& other) {
        ASSERT_EQ(one["points"].size(), other["points"].size());
        int apart = 0;
        for (std::size_t i = 0; i < one["points"].size(); ++i) {
            const Json& a = one["points"][i];
            const Json& b = other["points"][i];
            ASSERT_EQ(a["inside"], b["inside"]);
            apart +=
                !a["inside"].get<bool>() && (a["low"] > b["high"] || b["low"] > a["high"]) ? 1 : 0;
        }
        EXPECT_LE(apart, 1);
        EXPECT_LE(one["meanLow"], other["meanHigh"]);
        EXPECT_LE(other["meanLow"], one["meanHigh"]);
    }

    Daemon daemon_;
    JsonViewer viewer_;
};

TEST_F(MeasureTest, AWorkPlaneIsMeasuredOnce) {
    Json request = horizontal(0, 0, false, 0.1);
    request["measure"].erase("columns");
    request["measure"].erase("rows");
    request["measure"]["grid"] = "EN12464";
    const Json answer = viewer_.request(request);
    ASSERT_TRUE(answer.contains("measured")) << answer;
    const Json& found = answer["measured"];
    EXPECT_EQ(found["columns"], 8);
    EXPECT_EQ(found["rows"], 8);
    EXPECT_EQ(found["quantity"], "HORIZONTAL");
    EXPECT_EQ(found["epoch"], 0);
    ASSERT_EQ(found["points"].size(), 64U);
    EXPECT_LE(found["relativeError"], 0.1);
    EXPECT_GT(found["mean"], 20.0);
    EXPECT_LT(found["meanLow"], found["mean"]);
    EXPECT_LT(found["minimum"], found["maximum"]);
    // The short box stands in the plane.
    EXPECT_TRUE(std::any_of(found["points"].begin(), found["points"].end(),
                            [](const Json& point) { return point["inside"].get<bool>(); }));
    EXPECT_EQ(viewer_.request({{"removeMeasurement", {{"measurement", found["measurement"]}}}})
                  .at("error")
                  .at("code"),
              "NOT_FOUND");
}

TEST_F(MeasureTest, AKeptOneFollowsTheScene) {
    const Json first = viewer_.request(horizontal(4, 3, true, 0.05));
    ASSERT_TRUE(first.contains("measured")) << first;
    const Json number = first["measured"]["measurement"];
    expect_same(after(0, 0.05), viewer_.request(horizontal(4, 3, false, 0.05)).at("measured"));

    viewer_.request(
        {{"moveObject",
          {{"object", kShortBox}, {"transform", {{"translation", vec(-1.0, 0, 0.5)}}}}}});
    const Json moved = after(1, 0.05);
    EXPECT_EQ(moved["measurement"], number);
    expect_same(moved, viewer_.request(horizontal(4, 3, false, 0.05)).at("measured"));

    viewer_.request({{"setLight", {{"light", 1}, {"on", false}}}});
    const Json dark = after(2, 0.05);
    EXPECT_EQ(dark["mean"], 0.0);
    EXPECT_EQ(dark["maximumHigh"], 0.0);

    EXPECT_TRUE(viewer_.request({{"removeMeasurement", {{"measurement", number}}}}).contains("ok"));
}

TEST_F(MeasureTest, SixteenAreTheMost) {
    Json last;
    for (int i = 0; i < 16; ++i) {
        last = viewer_.request(horizontal(1, 1, true, 0.9));
        ASSERT_TRUE(last.contains("measured")) << last;
    }
    EXPECT_EQ(viewer_.request(horizontal(1, 1, true, 0.9)).at("error").at("code"),
              "RESOURCE_EXHAUSTED");
    viewer_.request({{"removeMeasurement", {{"measurement", last["measured"]["measurement"]}}}});
    EXPECT_TRUE(viewer_.request(horizontal(1, 1, true, 0.9)).contains("measured"));
}

TEST_F(MeasureTest, EveryQuantityHasItsUnitAndItsDirection) {
    const Json point = {{{"position", vec(2.75, 3.0, 2.75)}}};
    const auto mean = [&](const char* quantity, const Json& more) {
        Json request = {{"measure", {{"quantity", quantity}, {"points", point}}}};
        request["measure"].update(more);
        return viewer_.request(request).at("measured").value("mean", 0.0);
    };
    const double up = mean("HORIZONTAL", Json::object());
    EXPECT_NEAR(mean("NORMAL", {{"direction", vec(0, 2, 0)}}), up, 0.15 * up);
    EXPECT_LT(mean("VERTICAL", {{"direction", vec(1, 0, 0)}}), up);
    const double cylinder = mean("CYLINDRICAL", Json::object());
    EXPECT_GT(cylinder, 0.0);
    EXPECT_LT(cylinder, up);
    EXPECT_GT(mean("SEMICYLINDRICAL", {{"direction", vec(0, 0, 1)}}), 0.0);
    EXPECT_NEAR(mean("HORIZONTAL", {{"maintained", true}}), 0.8 * up, 0.15 * up);
    EXPECT_LT(mean("HORIZONTAL", {{"direct", true}}), up);
    const Json direct = {{"quantity", "HORIZONTAL"}, {"points", point}, {"direct", true}};
    EXPECT_TRUE(viewer_.request({{"measure", direct}}).at("measured").at("direct"));
    EXPECT_LT(mean("DAYLIGHT_FACTOR", Json::object()), 100.0);
}

}  // namespace
}  // namespace raybundle
