// SPDX-License-Identifier: Apache-2.0
// Photometric files that other programs write.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>

#include "case_files.h"
#include "gltf_builder.h"

namespace raybundle::test {
namespace {

using std::numbers::pi;

Scene floor_below(const std::string& ies) {
    SceneSettings settings;
    settings.ies = {"lamp=" + case_path("ies/" + ies)};
    return load_gltf(case_path("ies/floor.gltf"), settings);
}

double flux_of(const Scene& scene) {
    return place_light(scene, scene.punctual_lights[0]).flux().g;
}

std::string clean() {
    return std::regex_replace(case_bytes("ies/00_clean.ies"), std::regex("\r"), "");
}

std::string replaced(const std::string& text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return std::string(text).replace(at, what.size(), with);
}

std::string error_of(const std::string& text) {
    try {
        (void)parse_photometry("lamp.ies", text);
    } catch (const SceneError& error) {
        return error.json_path() + ": " + error.reason();
    }
    return "none";
}

/// I = 1000 cos: pi I lumens, 250 lx two metres below.
void expect_clean(const std::string& text) {
    const IesProfile profile = parse_ies("lamp.ies", text);
    EXPECT_NEAR(profile.flux(), 1000.0 * pi, 4.0);
    EXPECT_NEAR(profile.candela({0, 0, -1}), 1000.0, 1e-9);
    EXPECT_NEAR(profile.candela({std::sin(0.5), 0, -std::cos(0.5)}), 1000.0 * std::cos(0.5), 1.5);
}

TEST(CasesIes, FilesGiveTheRightIlluminance) {
    for (const char* file : {"00_clean.ies", "02_tilt_indented.ies", "05_bom_2019_factor.ies",
                             "11_negative_noise.ies", "13_upper_limit_135.ies"}) {
        const Scene scene = floor_below(file);
        EXPECT_NEAR(direct_illuminance(scene, {0, 0, 0}), 250.0, 0.01) << file;
        EXPECT_NEAR(flux_of(scene), 1000.0 * pi, 4.0) << file;
    }
    const Scene commas = floor_below("08b_decimal_comma_in_table.ies");
    EXPECT_NEAR(direct_illuminance(commas, {0, 0, 0}), 250.0, 0.01);
    EXPECT_NEAR(flux_of(commas), 1000.0 * pi, 4.0);
    EXPECT_TRUE(has_notice(commas, "08b_decimal_comma_in_table.ies': its decimal commas are read"));
    EXPECT_TRUE(has_notice(floor_below("11_negative_noise.ies"), "negative candela values"));
    EXPECT_TRUE(has_notice(floor_below("13_upper_limit_135.ies"), "end at 135°: it is dark"));
}

TEST(CasesIes, PlanesWithoutTheLastOneCloseTheCircle) {
    const Scene scene = load_gltf(case_path("ies/open_345.gltf"));
    for (int half_degrees = 0; half_degrees < 720; ++half_degrees) {
        const double a = glm::radians(0.5 * half_degrees);
        EXPECT_NEAR(direct_illuminance(scene, {2.0 * std::cos(a), 0, -2.0 * std::sin(a)}), 62.5,
                    0.05);
    }
    EXPECT_NEAR(flux_of(scene), 1000.0 * pi, 4.0);
    EXPECT_TRUE(has_notice(scene,
                           "'open_345.ies': its planes end at 345°: that at 360° is as that "
                           "at 0°"));
}

/// Those of symmetric files end one step early, too; the mirror image of the last plane is the
/// same.
TEST(CasesIes, PlanesOfSymmetricFilesCloseLikewise) {
    const auto file = [](const std::string& planes, const std::string& values) {
        return parse_ies("f", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 3 1 2 0 0 0\n1 1 1\n0 180\n" +
                                  planes + "\n" + values);
    };
    const IesProfile half = file("0 60 120", "10 10\n20 20\n30 30\n");
    EXPECT_NEAR(half.candela({-1, 0, 0}), 30.0, 1e-9);
    const IesProfile quadrant = file("0 30 60", "10 10\n20 20\n30 30\n");
    EXPECT_NEAR(quadrant.candela({0, 1, 0}), 30.0, 1e-9);
    EXPECT_NEAR(quadrant.candela({-1, 0, 0}), 10.0, 1e-9);
    EXPECT_EQ(
        error_of("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 3 1 2 0 0 0\n1 1 1\n0 180\n"
                 "0 90 200\n1 1 1 1 1 1\n"),
        "line 6: horizontal angles of type C go from 0 to 0, 90, 180 or 360; these end at 200, "
        "not one step of 110 before 360");
    EXPECT_EQ(
        error_of("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 1 2 0 0 0\n1 1 1\n0 180\n"
                 "0 45\n1 1 1 1\n"),
        "line 6: horizontal angles of type C go from 0 to 0, 90, 180 or 360; these end at 45, "
        "not one step of 45 before 90");
}

/// Type of generation in 2019, not used in 2002, a factor before.
TEST(CasesIes, TheThirdNumberIsAFactorUntil1995WhateverIsAroundTheHeader) {
    const std::string typed = replaced(clean(), "1 1 10", "1 1.1 10");
    const auto with = [&](const std::string& header) {
        return parse_ies("f", replaced(typed, "IESNA:LM-63-2002", header)).candela({0, 0, -1});
    };
    for (const std::string header :
         {"IES:LM-63-2019", "  IES:LM-63-2019", "\n\nIES:LM-63-2019", "IES:LM-63-2019   \t",
          "\xEF\xBB\xBF IES:LM-63-2019", "IES: LM-63-2019", "ies:lm-63-2019", "IES:LM-63-2019 (a)",
          "IESNA:LM-63-2002 ", "IESNA: LM-63-2002", "IESNA:LM-63-02"}) {
        EXPECT_NEAR(with(header), 1000.0, 1e-9) << header;
    }
    for (const std::string header : {"IESNA91", "IESNA:LM-63-1995 ", " IESNA:LM-63-1995",
                                     "A file of 1986", "[OTHER] LM-63-2019"}) {
        EXPECT_NEAR(with(header), 1100.0, 1e-9) << header;
    }
}

TEST(CasesIes, TiltIsReadHoweverItIsWritten) {
    for (const char* tilt :
         {"TILT = NONE", "\tTILT=NONE", "tilt=none", "Tilt = None  ",
          "TILT=INCLUDE\n1\n3\n0 90 180\n1 0.9 0.8", " tilt = include\n1\n3\n0 90 180\n1 0.9 0.8",
          "TILT=", "TILT=LAMP.TLT"}) {
        expect_clean(replaced(clean(), "TILT=NONE", tilt));
    }
    const IesProfile tilted =
        parse_ies("lamp.ies", replaced(clean(), "TILT=NONE", "TILT=..\\lamp.tlt"));
    ASSERT_EQ(tilted.data().notes.size(), 1U);
    EXPECT_NE(tilted.data().notes[0].find("file of tilt factors"), std::string::npos);
}

/// Ends of files of DOS, padding, form feeds, no-break spaces of Latin-1 and UTF-8.
TEST(CasesIes, ControlCharactersAreBlanks) {
    const std::string ends_with_digit = clean().substr(0, clean().find_last_of("0123456789") + 1);
    for (const std::string& end :
         {std::string("\x1a"), std::string(3, '\0'), std::string("\n\x1a"), std::string("\x7f\n"),
          std::string("\xA0"), std::string("\xC2\xA0")}) {
        expect_clean(ends_with_digit + end);
    }
    for (const char* blank : {"\f", "\v", "\xA0", "\xC2\xA0 "}) {
        expect_clean(replaced(clean(), "1 -1 1 19", std::string("1") + blank + "-1 1 19"));
    }
}

TEST(CasesIes, NegativeCountsSayThatIntensitiesAreAbsolute) {
    for (const char* lamps : {"-1 3140 1 19", "1 -2 1 19", "1 0 1 19"}) {
        expect_clean(replaced(clean(), "1 -1 1 19", lamps));
    }
}

TEST(CasesIes, LinesMayEndWithCarriageReturns) {
    expect_clean(std::regex_replace(clean(), std::regex("\n"), "\r"));
    expect_clean(std::regex_replace(clean(), std::regex("\n"), "\r\n"));
    const std::string broken = replaced(clean(), "984.808", "x");
    EXPECT_EQ(error_of(std::regex_replace(broken, std::regex("\n"), "\r")),
              "line 9: a candela value is not a number");
}

TEST(CasesIes, WideCharactersAreRead) {
    std::string little = "\xFF\xFE";
    std::string big = "\xFE\xFF";
    for (const char c : clean()) {
        little += {c, '\0'};
        big += {'\0', c};
    }
    expect_clean(little);
    expect_clean(big);
    expect_clean(little.substr(2));
    expect_clean(big.substr(2));
}

TEST(CasesIes, CommasSeparateNumbersOrAreDecimal) {
    // As separators, with and without blanks.
    const std::string text = clean();
    const std::size_t table = text.find("1 -1 1 19");
    for (const char* comma : {",", ", ", " ,"}) {
        expect_clean(text.substr(0, table) +
                     std::regex_replace(text.substr(table), std::regex("[ ]"), comma));
    }
    // Everywhere decimal.
    const std::string decimal =
        text.substr(0, table) + std::regex_replace(text.substr(table), std::regex("\\."), ",");
    expect_clean(decimal);
    expect_clean(replaced(decimal, "1 -1 1 19 1", "1,0 -1,0 1,0 19 1"));
    expect_clean(replaced(decimal, "TILT=NONE", "TILT=INCLUDE\n1\n2\n0 90\n1,0 0,9"));
    // Not to be read: a value is missing, or the comma may be one of thousands.
    EXPECT_EQ(error_of(replaced(decimal, "1000 ", "")),
              "line 9: decimal comma in \"996,195\": numbers have decimal points");
    EXPECT_EQ(error_of("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n"
                       "1,500 1,200\n"),
              "line 7: decimal comma in \"1,500\": numbers have decimal points");
}

TEST(CasesIes, NoiseBelowZeroIsDarkAndMoreIsRefused) {
    EXPECT_EQ(parse_ies("f", case_bytes("ies/11_negative_noise.ies")).candela({1, 0, 0}), 0.0);
    EXPECT_EQ(error_of(replaced(clean(), "6.12323e-14", "-20")),
              "line 9: a candela value is -20: more than noise");
}

TEST(CasesIes, VerticalAnglesMayEndAnywhere) {
    const auto ends_at = [](double last) {
        return parse_ies("f", fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n"
                                          "1 1 1\n0 {}\n0\n100 100\n",
                                          last));
    };
    for (const double last : {30.0, 85.0, 90.0, 135.0, 175.0, 180.0}) {
        const IesProfile profile = ends_at(last);
        const double exact = 200.0 * pi * (1.0 - std::cos(glm::radians(last)));
        EXPECT_NEAR(profile.flux(), exact, 1e-3 * exact) << last;
        EXPECT_EQ(profile.data().notes.empty(), last == 90.0 || last == 180.0);
    }
    EXPECT_EQ(error_of("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 1\n10 90\n0\n1 1\n"),
              "line 6: vertical angles of type C begin at 0 or 90 and are at least two");
}

TEST(CasesIes, LimitsThatAreRoundedAreMeantAsTheyAre) {
    const IesProfile profile =
        parse_ies("f",
                  "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 3 1 2 0 0 0\n1 1 1\n0.01 90 179.99\n"
                  "0 180 359.99\n10 10 10\n20 20 20\n10 10 10\n");
    EXPECT_TRUE(profile.data().notes.empty());
    EXPECT_NEAR(profile.candela({0, 0, -1}), 10.0, 1e-9);
    EXPECT_NEAR(profile.candela({0, -1, 0}), 15.0, 1e-9);
    // The only plane of a round luminaire may have any angle.
    const IesProfile round = parse_ies(
        "f", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 180\n45\n10 10\n");
    EXPECT_NEAR(round.candela({0, -1, 0}), 10.0, 1e-9);
}

/// Floodlights (types A and B) have only the angles of their beam.
TEST(CasesIes, AnglesOfFloodlightsMayEndWithTheBeam) {
    for (const int type : {2, 3}) {
        const IesProfile profile =
            parse_ies("f", fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 2 {} 1 0 0 0\n1 1 1\n"
                                       "-40 0 40\n0 50\n1 10 5\n1 10 5\n",
                                       type));
        EXPECT_NEAR(profile.candela({0, 0, -1}), 10.0, 1e-9);
        EXPECT_EQ(profile.candela({1, 0, -0.1}), 0.0);
        EXPECT_EQ(profile.data().notes.size(), 2U);
    }
}

TEST(CasesIes, OtherFormatsAreNamed) {
    // EULUMDAT is read, whatever its file is called; errors are of its own lines.
    EXPECT_EQ(error_of("Maker\r\n1\r\n0\r\n24\r\n15\r\n19\r\n5,0\r\nreport\r\n"),
              "line 9: the file ends where the name should be");
    // Latin-1, blanks, signs, exponents, CR alone, lines ended twice.
    for (const char* eulumdat :
         {"H\xe4user GmbH \xb0\n 1 \n0\n24\n15\n37\n2.5\nr\n",
          "Maker\r\r\n+1\r\r\n 0\r\r\n24,0\r\r\n1,5E+01\r\r\n37\r\r\n2.5\r\r\nr\r\r\n",
          "\xEF\xBB\xBFMaker\n2\n1\n36\n0\n91\n1\n\n"}) {
        EXPECT_EQ(error_of(eulumdat), "line 9: the file ends where the name should be") << eulumdat;
    }
    EXPECT_EQ(error_of("Maker\n1\n2\n3\n"), "line 5: there is no line that begins with TILT=");
    EXPECT_EQ(error_of("<!DOCTYPE html><title>404</title>"),
              "line 1: this is XML or HTML, not the text of LM-63");
    EXPECT_EQ(error_of("\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<IESTM33-18/>"),
              "line 1: this is XML or HTML, not the text of LM-63");
    EXPECT_EQ(error_of(clean() + "0 0\n"),
              "line 10: more numbers follow than 19 x 1 candela values");
}

TEST(CasesIes, MirroredLuminairesThrowToTheMirroredSide) {
    const Scene plain = load_gltf(case_path("ies/plain.gltf"));
    const Scene mirrored = load_gltf(case_path("ies/mirror_x.gltf"));
    EXPECT_NEAR(direct_illuminance(plain, {0, 0, -3}), 39.28, 0.01);
    EXPECT_NEAR(direct_illuminance(plain, {0, 0, 3}), 0.39, 0.01);
    for (const glm::dvec3 point :
         {glm::dvec3(0, 0, -3), glm::dvec3(0, 0, 3), glm::dvec3(2, 0, -1), glm::dvec3(-2, 0, -1)}) {
        EXPECT_NEAR(direct_illuminance(mirrored, point), direct_illuminance(plain, point), 1e-4);
    }
}

}  // namespace
}  // namespace raybundle::test
