// SPDX-License-Identifier: Apache-2.0
// `raybundle measure`, on a machine made to have no OpenGL.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

namespace {

struct Outcome {
    int status = -1;
    std::string text;
};

Outcome measure(const std::string& arguments, const std::string& scene = "cornell_box") {
    const std::string command =
        "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent "
        "RAYBUNDLE_TEST_CLOCK_MS=20 " RAYBUNDLE_EXECUTABLE
        " measure --log-level off " RAYBUNDLE_SCENES "/" +
        scene + ".gltf " + arguments + " 2>&1";
    Outcome outcome;
    FILE* const pipe = popen(command.c_str(), "r");
    std::array<char, 4096> part;
    for (std::size_t n = 0; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) {
        outcome.text.append(part.data(), n);
    }
    const int status = pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

const std::string plane = "--plane 0.5,0.75,0.5 4.5,0,0 0,0,4.5 ";

TEST(MeasureCommand, PrintsEachPointAndAllTogether) {
    const Outcome found = measure(plane + "--json --error 0.05");
    ASSERT_EQ(found.status, 0) << found.text;
    const auto json = nlohmann::json::parse(found.text);
    EXPECT_EQ(json["columns"], 8);
    EXPECT_EQ(json["rows"], 8);
    ASSERT_EQ(json["points"].size(), 64U);
    EXPECT_GT(json["inside"], 5);
    EXPECT_LE(json["relativeError"], 0.05);
    EXPECT_LT(json["mean"]["low"], json["mean"]["value"]);
    EXPECT_LE(json["minimum"]["low"], json["minimum"]["value"]);
    const Outcome again = measure(plane + "--json --error 0.05");
    const auto second = nlohmann::json::parse(again.text);
    EXPECT_EQ(json["points"], second["points"]);  // the same seed, the same bits
}

TEST(MeasureCommand, TheTableNamesItsRule) {
    const Outcome found = measure(plane + "--grid 3x2 --quantity cylindrical --error 0.2");
    EXPECT_EQ(found.status, 0);
    EXPECT_NE(found.text.find("CYLINDRICAL, lx"), std::string::npos);
    EXPECT_NE(found.text.find("Uo"), std::string::npos);
    EXPECT_EQ(found.text.find("EN 12464"), std::string::npos);
    EXPECT_NE(measure(plane + "--error 0.2").text.find("EN 12464-1: 8 x 8"), std::string::npos);
}

TEST(MeasureCommand, ExactValuesHaveNoErrorAndKeepApart) {
    const Outcome found =
        measure("--plane 0,0.75,0 6,0,0 0,0,5 --direct --patch-size 1", "examples/office");
    EXPECT_EQ(found.status, 0);
    EXPECT_EQ(found.text.find("e-"), std::string::npos) << found.text;
    // Of nine columns that of the middle has these neighbours: 636.32 by a sum over 60 x 60 points
    // of each panel.
    EXPECT_NE(found.text.find(" 636.3 ±0 "), std::string::npos) << found.text;
}

TEST(MeasureCommand, ItsStatusSaysWhetherTheRequirementIsMet) {
    EXPECT_EQ(measure(plane + "--require 20").status, 0);
    EXPECT_EQ(measure(plane + "--require 500").status, 5);
    EXPECT_EQ(measure(plane + "--require 20/0.9").status, 5);
    // Nobody will know in so short a time.
    EXPECT_EQ(
        measure("--point 1,4,1 --seconds 0.1 --require " +
                nlohmann::json::parse(measure("--point 1,4,1 --json").text)["mean"]["value"].dump())
            .status,
        6);
}

TEST(MeasureCommand, RatesGlareAndNamesWhatGlares) {
    const std::string seat = "--point 2.75,1.2,0.3 --quantity ugr --directions 8 ";
    const Outcome found = measure(seat + "--json --require 60");
    ASSERT_EQ(found.status, 0) << found.text;
    const auto json = nlohmann::json::parse(found.text);
    const auto& glare = json["points"][0]["glare"];
    EXPECT_EQ(glare["state"], "RATED");
    EXPECT_EQ(glare["sources"][0]["light"], 1);
    EXPECT_LT(json["points"][0]["low"], json["points"][0]["high"]);
    EXPECT_FALSE(json.contains("uniformity"));
    EXPECT_EQ(json["requirement"]["checks"][0]["what"], "UGR");
    EXPECT_EQ(measure(seat + "--require 5").status, 5);
    const Outcome text = measure(seat);
    EXPECT_NE(text.text.find("worst view"), std::string::npos);
    EXPECT_NE(text.text.find("100.0 %"), std::string::npos) << text.text;
    EXPECT_EQ(measure("--point 1,1,1 --quantity ugr").status, 2);  // looking where?
    EXPECT_EQ(measure("--point 1,1,1 --quantity ugr --directions 5").status, 2);
    EXPECT_EQ(measure("--point 2.75,1.2,0.3 --quantity dgp --direction 0,0,1 --error 0.5").status,
              0);
}

/// The box's lamp is a surface, of which no file states anything: that ends before all seconds.
TEST(MeasureCommand, NamesTheLuminairesAndWhetherTheyStateTheirColourRendering) {
    const Outcome found = measure(plane + "--json --error 0.3 --seconds 500 --require 20/0/80");
    EXPECT_EQ(found.status, 6) << found.text;
    const auto json = nlohmann::json::parse(found.text);
    ASSERT_EQ(json["luminaires"].size(), 1U) << found.text;
    EXPECT_EQ(json["luminaires"][0]["light"], 1);
    EXPECT_EQ(json["luminaires"][0]["share"], 1.0);
    EXPECT_FALSE(json["luminaires"][0].contains("colourRendering"));
    EXPECT_EQ(json["requirement"]["colourRendering"], 80.0);
    const auto& check = json["requirement"]["checks"].back();
    EXPECT_EQ(check["what"], "Ra");
    EXPECT_EQ(check["verdict"], "not yet known");
    EXPECT_EQ(check["words"], "not stated by " + json["luminaires"][0]["name"].get<std::string>());
}

TEST(MeasureCommand, MeasuresPolygonsAndTheStripsAroundThem) {
    const std::string corners = "--outline 1,3,1 4,3,1 4,3,4 --error 0.5 --json --grid 8x8 ";
    const auto within = nlohmann::json::parse(measure(corners).text);
    EXPECT_NEAR(static_cast<double>(within["points"].size()), 32.0, 4.0);
    const auto around = nlohmann::json::parse(measure(corners + "--surrounding 0.5").text);
    EXPECT_GT(around["points"].size(), 5U);
    for (const auto& point : around["points"]) {
        const double x = point["position"]["x"];
        const double z = point["position"]["z"];
        EXPECT_FALSE(x > 1.0 && x < 4.0 && z > 1.0 && z < x);
    }
    const Outcome maintained = measure(corners + "--maintained");
    EXPECT_NEAR(nlohmann::json::parse(maintained.text)["mean"]["value"],
                0.8 * within["mean"]["value"].get<double>(), 1e-3);
    EXPECT_EQ(measure("--outline 1,1,1 2,1,1 3,1,1").status, 2);
    const Outcome crossed = measure("--outline 1,1,1 4,1,4 4,1,1 1,1,3");
    EXPECT_EQ(crossed.status, 2);
    EXPECT_NE(crossed.text.find("--outline: crosses itself: the edge from corner 1 to 2 meets that "
                                "from corner 3 to 4"),
              std::string::npos)
        << crossed.text;
}

TEST(MeasureCommand, RefusesWhatSaysNothing) {
    EXPECT_EQ(measure("").status, 2);
    EXPECT_EQ(measure("--plane 0,0,0 1,0,0 2,0,0").status, 2);
    EXPECT_EQ(measure("--plane 0,0,0 1,0,0 0,0,1 --grid 100x100").status, 2);
    EXPECT_EQ(measure("--plane 0,0,0 1,0,0 0,0,1 --grid 0x1").status, 2);
    EXPECT_EQ(measure("--plane 0,0,0 1,0,0 0,0,1 --margin 0.5").status, 2);
    EXPECT_EQ(measure("--point 1,1,1 --quantity vertical").status, 2);
    EXPECT_EQ(measure("--point 1,1,1 --quantity vertical --direction 0,1,0").status, 2);
    EXPECT_EQ(measure("--point 1,1,1 --quantity lumen").status, 2);
    EXPECT_EQ(measure("--point 1,1,1 --require 100/2").status, 2);
    EXPECT_EQ(measure("--point 1,1,1 --require x").status, 2);
    EXPECT_EQ(measure("--point 1,1,1 --require 100/0.5/101").status, 2);
    EXPECT_EQ(measure("--point 1,1,1 --quantity cylindrical --require 100/0.5/80").status, 2);
    EXPECT_EQ(measure("--point 1,1,1 --maintenance 1.1").status, 2);
}

/// A closed box without a window.
TEST(MeasureCommand, TheDaylightFactorLeavesLampsOut) {
    const Outcome found =
        measure("--point 2.75,1,1.5 --point 0.3,5,0.3 --quantity daylight_factor --json");
    ASSERT_EQ(found.status, 0) << found.text;
    const auto json = nlohmann::json::parse(found.text);
    EXPECT_EQ(json["unit"], "%");
    EXPECT_LT(json["maximum"]["value"], 100.0);
}

}  // namespace
