// SPDX-License-Identifier: Apache-2.0
#include "research/accuracy/accuracy_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "research/accuracy/error_map.h"
#include "research/accuracy/picture_store.h"
#include "scene/base64.h"
#include "xml_check.h"

namespace raybundle {
namespace {

CurvePoint point(unsigned checkpoint, double seconds, double error) {
    CurvePoint result;
    result.checkpoint = checkpoint;
    result.seconds = seconds;
    result.iterations = static_cast<std::uint64_t>(seconds * 100.0);
    result.relative_rmse = error;
    result.mrse = error * error;
    result.median = 0.7 * error;
    result.p95 = 2.0 * error;
    result.estimated_error = 1.1 * error;
    result.estimated_low = 0.7 * error;
    result.estimated_high = 2.0 * error;
    return result;
}

ErrorCurve curve(const std::string& name, const std::string& knob, bool by_bundles) {
    ErrorCurve result{name, name, knob, by_bundles, {{"bytes", 1000000}, {"seed", 1}}, {}};
    result.points = {point(0, 1.0, 0.2), point(1, 2.0, 0.09), point(2, 4.0, 0.04)};
    return result;
}

AccuracyReport report() {
    AccuracyReport result;
    result.scene = "box";
    result.camera = "front";
    result.device = "a GPU";
    result.processor = "a CPU";
    result.size = {2, 1};
    result.patches = 12;
    result.seconds = 4.0;
    result.seed = 7;
    result.references = {{PixelFilter::centre, "path-reuse", "out/reference.exr",
                          ReferenceNoise{0.005, 1e-4}, 64, 3.5},
                         {PixelFilter::box, "", "out/reference_area.exr", std::nullopt, 0, 0.0}};
    result.curves = {curve("combined", "", true), curve("path", "", false),
                     curve("edges halved", "patch size", true)};
    const std::vector<std::uint8_t> rgba = {1, 2, 3, 255, 4, 5, 6, 255};
    result.pictures = {{"reference", 0.0, 0.0, png_of(rgba, {2, 1}), ""},
                       {"combined", 4.0, 0.04, png_of(rgba, {2, 1}), png_of(rgba, {2, 1})}};
    return result;
}

TEST(AccuracyJson, HasWhatScriptsDependOn) {
    const nlohmann::ordered_json json = accuracy_json(report());
    EXPECT_EQ(json["scene"], "box");
    EXPECT_EQ(json["device"], "a GPU");
    EXPECT_EQ(json["size"], (nlohmann::ordered_json{2, 1}));
    EXPECT_EQ(json["patches"], 12);
    EXPECT_EQ(json["reference"]["method"], "path-reuse");
    EXPECT_EQ(json["reference"]["seconds"], 3.5);
    EXPECT_EQ(json["reference"]["relativeError"], 0.005);
    EXPECT_TRUE(json["references"][1]["relativeError"].is_null());
    EXPECT_TRUE(json["references"][1]["method"].is_null());
    ASSERT_EQ(json["curves"].size(), 3U);
    const auto& first = json["curves"][0];
    EXPECT_EQ(first["method"], "combined");
    EXPECT_TRUE(first["settings"].is_object());
    ASSERT_EQ(first["points"].size(), 3U);
    for (const char* key :
         {"seconds", "iterations", "relRMSE", "mrse", "median", "p95", "estimatedError"}) {
        EXPECT_TRUE(first["points"][0][key].is_number()) << key;
    }
    EXPECT_EQ(first["secondsToError"][0]["error"], 0.1);
    EXPECT_NEAR(first["secondsToError"][0]["seconds"].get<double>(), 1.82, 0.02);
    EXPECT_TRUE(first["secondsToError"][2]["seconds"].is_null());
    EXPECT_EQ(json["curves"][2]["knob"], "patch size");
}

TEST(AccuracyJson, HasNullWhereANumberIsNone) {
    AccuracyReport broken = report();
    broken.curves[0].points[0].estimated_error = std::numeric_limits<double>::infinity();
    broken.curves[0].points[0].mrse = std::numeric_limits<double>::quiet_NaN();
    const auto json = nlohmann::ordered_json::parse(accuracy_json(broken).dump());
    EXPECT_TRUE(json["curves"][0]["points"][0]["estimatedError"].is_null());
    EXPECT_TRUE(json["curves"][0]["points"][0]["mrse"].is_null());
}

TEST(AccuracyPlots, AreOneForEachQuestionWithNamesOfTheirOwn) {
    std::set<std::string> files;
    for (const NamedPlot& plot : accuracy_plots(report())) {
        files.insert(plot.file);
        EXPECT_EQ(xml_fault(svg_of(plot.plot)), "") << plot.file;
    }
    EXPECT_EQ(files, (std::set<std::string>{"error_over_time.svg", "error_over_iterations.svg",
                                            "estimate_combined.svg", "estimate_path.svg",
                                            "knob_patch_size.svg"}));
}

TEST(AccuracyPlots, TellWhatTheReferenceDoesNotResolve) {
    AccuracyReport coarse = report();
    coarse.curves[0].points.back().resolved = false;
    const LinePlot plot = accuracy_plots(coarse)[0].plot;
    EXPECT_FALSE(plot.series[0].points.back().firm);
    EXPECT_TRUE(plot.series[0].points.front().firm);
    EXPECT_TRUE(plot.series[1].points.back().firm);
    EXPECT_NE(accuracy_page(coarse).find("Open markers"), std::string::npos);
    EXPECT_EQ(accuracy_page(report()).find("Open markers"), std::string::npos);
}

TEST(AccuracyPlots, KeepAMethodsColourInEveryPlot) {
    const std::vector<NamedPlot> plots = accuracy_plots(report());
    EXPECT_EQ(plots[0].plot.series[1].name, "path");
    EXPECT_EQ(plots[0].plot.series[1].style, plots[3].plot.series[0].style);
    // Iterations of CPU methods are something else.
    EXPECT_EQ(plots[1].plot.series.size(), 1U);
}

TEST(AccuracyPage, StandsForItself) {
    const std::string page = accuracy_page(report());
    EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
    for (const char* part :
         {"<b>combined</b> was the first", "time to 5\xC2\xA0%", "data:image/png;base64,", "<svg",
          "Knob: patch size", "a GPU", "seed 7", "accuracy unknown"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    // Nothing is loaded from elsewhere; the one address is the name of SVG's vocabulary.
    for (const char* part : {"<script", "<link", "src=\"http", "url(", ">nan", " nan", " inf"}) {
        EXPECT_EQ(page.find(part), std::string::npos) << part;
    }
}

TEST(AccuracyPage, EscapesNamesFromFiles) {
    AccuracyReport odd = report();
    odd.scene = "<img src=x onerror=alert(1)>";
    odd.camera = "\"><script>";
    const std::string page = accuracy_page(odd);
    EXPECT_EQ(page.find("<img src=x"), std::string::npos);
    EXPECT_EQ(page.find("<script"), std::string::npos);
}

TEST(ErrorMap, IsBlueWhereDarkRedWhereBrightPaleWhereRightGreyWhereNothingCounts) {
    const std::vector<glm::dvec3> reference(4, glm::dvec3(1.0));
    const std::vector<glm::dvec3> image = {glm::dvec3(0.5), glm::dvec3(1.5), glm::dvec3(1.0),
                                           glm::dvec3(9.0)};
    const std::vector<std::uint8_t> map =
        error_map(image, reference, {true, true, true, false}, 0.1);
    ASSERT_EQ(map.size(), 16U);
    EXPECT_GT(map[2], map[0] + 100);  // blue over red
    EXPECT_GT(map[4], map[6] + 100);
    EXPECT_EQ(map[8], 247);
    EXPECT_EQ(map[12], 128);
    EXPECT_EQ(error_map_scale(0.03), 0.05);
    EXPECT_EQ(error_map_scale(7.0), 1.0);
}

TEST(Base64, IsThatOfRfc4648) {
    const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : vectors) {
        EXPECT_EQ(base64(bytes), text);
    }
}

TEST(PictureStore, GivesPicturesBack) {
    PictureStore store(3);
    const std::vector<glm::dvec3> a(3, glm::dvec3(1.0, 2.0, 3.0));
    const std::vector<glm::dvec3> b(3, glm::dvec3(0.5));
    EXPECT_EQ(store.add(a), 0U);
    EXPECT_EQ(store.add(b), 1U);
    EXPECT_TRUE(store.picture(0) == a);
    EXPECT_TRUE(store.picture(1) == b);
    EXPECT_EQ(store.add(a), 2U);
    EXPECT_TRUE(store.picture(1) == b);
    EXPECT_THROW((void)store.picture(3), std::out_of_range);
    EXPECT_THROW((void)store.add(std::vector<glm::dvec3>(2)), std::invalid_argument);
}

}  // namespace
}  // namespace raybundle
