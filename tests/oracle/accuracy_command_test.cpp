// SPDX-License-Identifier: Apache-2.0
// `raybundle accuracy` with ray bundles: the whole way from the scene to the page.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// By this clock 10 ms pass with each iteration, on any machine and whatever it compiles first.
#define ACCURACY "RAYBUNDLE_TEST_CLOCK_MS=10 " RAYBUNDLE_EXECUTABLE " accuracy --log-level off "

TEST(AccuracyCommand, MeasuresRayBundlesBesideAReferenceMethod) {
    const fs::path folder = fs::path(testing::TempDir()) / "raybundle_accuracy_bundles";
    fs::remove_all(folder);
    const std::string command = ACCURACY RAYBUNDLE_SCENES
                                "/cornell_box.gltf --size 32x32 --patch-size 0.5 --seconds 3 "
                                "--reference-seconds 4 --methods combined,path -o '" +
                                folder.string() + "' >/dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::ifstream stream(folder / "accuracy.json");
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    ASSERT_TRUE(json.is_object());
    EXPECT_FALSE(json["device"].get<std::string>().empty());
    ASSERT_EQ(json["curves"].size(), 2U);
    EXPECT_EQ(json["curves"][0]["method"], "combined");
    EXPECT_EQ(json["curves"][0]["pixelFilter"], "area");
    EXPECT_EQ(json["curves"][1]["pixelFilter"], "area");
    const auto& points = json["curves"][0]["points"];
    ASSERT_GE(points.size(), 3U);
    // One progressive run: iterations only grow, and the last picture is better than the first.
    for (std::size_t i = 1; i < points.size(); ++i) {
        EXPECT_GT(points[i]["iterations"].get<int>(), points[i - 1]["iterations"].get<int>());
    }
    EXPECT_LT(points.back()["relRMSE"].get<double>(), points.front()["relRMSE"].get<double>());
    EXPECT_LT(points.back()["relRMSE"].get<double>(), 0.3);
    for (const char* name : {"index.html", "reference_area.exr", "estimate_combined.svg"}) {
        EXPECT_TRUE(fs::exists(folder / name)) << name;
    }
    fs::remove_all(folder);
}

/// What viewers see first, counted in iterations.
TEST(HeavyAccuracyCommand, MeasuresTheFirstPicturesOfAViewer) {
    const fs::path folder = fs::path(testing::TempDir()) / "raybundle_accuracy_early";
    fs::remove_all(folder);
    const std::string command = ACCURACY RAYBUNDLE_SCENES
                                "/cornell_box.gltf --early --size 32x24 --patch-size 0.5 "
                                "--reference-seconds 2 -o '" +
                                folder.string() + "' >/dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::ifstream stream(folder / "early.json");
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    ASSERT_TRUE(json.is_object());
    const auto& first = json["sinceNothing"];
    ASSERT_EQ(first.size(), 7U);
    EXPECT_EQ(first.front()["iterations"], 1);
    EXPECT_LT(first.back()["relRMSE"].get<double>(), first.front()["relRMSE"].get<double>());
    EXPECT_GT(first.back()["ssim"].get<double>(), first.front()["ssim"].get<double>());
    const auto& turned = json["sinceTurn"];
    ASSERT_EQ(turned.size(), 8U);
    EXPECT_EQ(turned.front()["iterations"], 0);
    for (const char* name : {"early.svg", "reference.png", "nothing_0008.png", "turn_0000.png"}) {
        EXPECT_TRUE(fs::exists(folder / name)) << name;
    }
    fs::remove_all(folder);
}

/// By default methods are left out that know no glass (single rays) or do not see what is behind it
/// (light tracing). Named, the one runs and the other is an error.
TEST(AccuracyCommand, HeavyMeasuresASceneWithGlassByTheMethodsThatKnowIt) {
    const fs::path folder = fs::path(testing::TempDir()) / "raybundle_accuracy_glass";
    fs::remove_all(folder);
    const std::string command = ACCURACY RAYBUNDLE_SCENES
                                "/effects/glass.gltf --size 16x16 --patch-size 0.5 --seconds 0.2 "
                                "--reference-seconds 1 -o '" +
                                folder.string() + "' 2>/dev/null >/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::ifstream stream(folder / "accuracy.json");
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    std::vector<std::string> methods;
    for (const auto& curve : json.at("curves")) {
        methods.push_back(curve.at("method"));
    }
    EXPECT_EQ(methods, (std::vector<std::string>{"combined", "parallel-layered", "parallel-plane",
                                                 "perspective", "path", "bidirectional",
                                                 "metropolis", "photon-map"}));
    EXPECT_EQ(WEXITSTATUS(std::system((command + " --methods light").c_str())), 0);
    fs::remove_all(folder);
    EXPECT_EQ(WEXITSTATUS(std::system((command + " --methods single-ray").c_str())), 1);
}

}  // namespace
