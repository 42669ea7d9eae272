// SPDX-License-Identifier: Apache-2.0
// A server whose viewers have what they want does nothing, until one wants something else.
#include <gtest/gtest.h>

#include <string>

#include "daemon.h"
#include "json_viewer.h"

namespace raybundle {
namespace {

constexpr double target = 0.25;

/// Turns of the server's loop so far.
int turns(std::uint16_t port) {
    const std::string text =
        http_exchange(port, "GET /metrics HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
    const std::string name = "\nraybundle_loop_turns_total ";
    const std::size_t found = text.find(name);
    return found == std::string::npos ? -1 : std::stoi(text.substr(found + name.size()));
}

class TargetTest : public testing::Test {
  protected:
    TargetTest() { viewer_.join("", 160, 120); }

    [[nodiscard]] Json next_solution(JsonViewer& viewer) {
        return viewer.next_with("solution").value("solution", Json::object());
    }
    /// Waits until no iteration has been done for a second and a half; the last solution.
    Json rest(JsonViewer& viewer) {
        Json last = next_solution(viewer);
        int same = 0;
        for (int i = 0; i < 1600 && same < 6 && !last.empty(); ++i) {
            const Json now = next_solution(viewer);
            same = now.value("iterations", 0) == last.value("iterations", 0) ? same + 1 : 0;
            last = now;
        }
        EXPECT_GE(same, 6) << "it never rested: " << last.dump();
        return last;
    }
    /// The next solution with at least so many iterations.
    bool goes_on_to(int iterations) {
        const auto enough = [&](const Json& m) {
            return m.contains("solution") && m["solution"].value("iterations", 0) >= iterations;
        };
        return !viewer_.next(enough).empty();
    }
    /// Rests at its target again, having worked for it.
    Json rests_after_work(const Json& before) {
        const int iterations = before.value("iterations", 0);
        EXPECT_TRUE(goes_on_to(iterations + 16));
        const Json after = rest(viewer_);
        EXPECT_LE(after.value("errorHigh", 1.0), target) << after.dump();
        return after;
    }

    Daemon daemon_{scene_file("cornell_box.gltf")};
    JsonViewer viewer_{daemon_.port()};
};

TEST_F(TargetTest, TheSolverRestsAtTheTargetAndWakesForAChange) {
    viewer_.request({{"setTarget", {{"relativeError", target}}}});
    ASSERT_TRUE(goes_on_to(16));
    Json at_rest = rest(viewer_);
    EXPECT_LE(at_rest.value("errorHigh", 1.0), target) << at_rest.dump();
    EXPECT_EQ(at_rest.value("secondsToTarget", 1.0), 0.0) << at_rest.dump();
    // It waits between its turns: 50 ms, and a quarter of a second between two solutions. A slow
    // machine makes fewer turns, one that spins makes thousands.
    constexpr int solutions = 8;
    EXPECT_FALSE(next_solution(viewer_).empty());
    const int before = turns(daemon_.port());
    EXPECT_GT(before, 0);
    for (int i = 0; i < solutions; ++i) {
        EXPECT_FALSE(next_solution(viewer_).empty());
    }
    EXPECT_LE(turns(daemon_.port()) - before, 2 * 5 * solutions);

    viewer_.request({{"setCamera",
                      {{"eye", {{"x", 2.2}, {"y", 2.2}, {"z", -6.5}}},
                       {"target", {{"x", 2.7}, {"y", 2.7}, {"z", 2.7}}}}}});
    at_rest = rests_after_work(at_rest);
    viewer_.request({{"moveObject",
                      {{"object", 2},
                       {"transform", {{"translation", {{"x", 2.4}, {"y", 0.825}, {"z", 1.7}}}}}}}});
    at_rest = rests_after_work(at_rest);
    viewer_.request({{"setLight", {{"light", 1}, {"intensity", 500.0}}}});
    rests_after_work(at_rest);
}

TEST_F(TargetTest, SecondsAreATargetToo) {
    viewer_.request({{"setTarget", {{"seconds", 2.0}}}});
    EXPECT_GE(rest(viewer_).value("iterations", 0), 1);
    // Somebody else who wants everything.
    const int iterations = next_solution(viewer_).value("iterations", 0);
    JsonViewer other(daemon_.port());
    other.join("", 160, 120);
    EXPECT_TRUE(goes_on_to(iterations + 16));
}

/// What is said of a picture at rest is measured by path tracing, and is forgotten when it shows
/// something else.
TEST_F(TargetTest, APictureAtRestHasItsErrorMeasured) {
    const auto measured = [](bool yes) {
        return [yes](const Json& m) {
            return m.contains("solution") && m["solution"].contains("errorMeasured") &&
                   m["solution"].value("errorMeasured", !yes) == yes;
        };
    };
    const Json found = viewer_.next(measured(true));
    ASSERT_FALSE(found.empty()) << "it was never measured";
    const Json& solution = found["solution"];
    EXPECT_LT(solution.value("errorLow", 1.0), solution.value("relativeError", 0.0));
    EXPECT_GT(solution.value("errorHigh", 0.0), solution.value("relativeError", 1.0));
    viewer_.request({{"setCamera",
                      {{"eye", {{"x", 2.2}, {"y", 2.2}, {"z", -6.5}}},
                       {"target", {{"x", 2.7}, {"y", 2.7}, {"z", 2.7}}}}}});
    EXPECT_FALSE(viewer_.next(measured(false)).empty());
    EXPECT_FALSE(viewer_.next(measured(true)).empty());
}

}  // namespace
}  // namespace raybundle
