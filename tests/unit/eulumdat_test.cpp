// SPDX-License-Identifier: Apache-2.0
// EULUMDAT files against the intensities that they were written from, and against the same
// luminaires as IES files.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <regex>
#include <vector>

#include "gltf_builder.h"
#include "scene/photometry/ies_profile.h"

namespace raybundle::test {
namespace {

using std::numbers::pi;
using Intensity = std::function<double(double, double)>;  // of gamma and C, radians; cd/klm

glm::dvec3 towards(double gamma, double c) {
    return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), -std::cos(gamma)};
}

TEST(ColourRendering, IsReadAsFilesWriteIt) {
    struct Case {
        const char* text;
        float least, most;
    };
    for (const Case& c : {Case{"80", 80, 80},
                          {" 83.5", 83.5F, 83.5F},
                          {"83,5", 83.5F, 83.5F},
                          {"1B", 80, 89},
                          {"1a ", 90, 100},
                          {"2A", 70, 79},
                          {"3", 40, 59},
                          {"4", 20, 39},
                          {"1B/85", 85, 85},
                          {"1B (80-89)", 80, 89},
                          {"Ra > 80", 80, 100},
                          {">=90", 90, 100},
                          {"80+", 80, 100},
                          {"80 - 89", 80, 89},
                          {"CRI 92", 92, 92},
                          {"830", 80, 89},
                          {"940/93", 90, 100},
                          {"4000K Ra 80", 80, 80},
                          {"3000 K / CRI > 90", 90, 100},
                          {"35W/840", 80, 89},
                          {"58 W, 80", 80, 80},
                          {"100", 100, 100}}) {
        const auto known = read_colour_rendering(c.text);
        ASSERT_TRUE(known) << c.text;
        EXPECT_EQ(known->least, c.least) << c.text;
        EXPECT_EQ(known->most, c.most) << c.text;
    }
    for (const char* const silent :
         {"", "-", "0", "1", "n/a", "warm white", "4000", "-1", "36 W", "4000 K"}) {
        EXPECT_FALSE(read_colour_rendering(silent)) << silent;
    }
    EXPECT_EQ(keyword_colour_rendering("[_CRI] 92")->least, 92.0F);
    EXPECT_EQ(keyword_colour_rendering("[Color Rendering Index] >80")->most, 100.0F);
    EXPECT_FALSE(keyword_colour_rendering("[LAMP] LED 840 CRI 80"));
    EXPECT_FALSE(keyword_colour_rendering("CRI 80"));
    EXPECT_EQ(text_of(ColourRendering{80, 89}), "80 to 89");
    EXPECT_EQ(text_of(ColourRendering{83.5F, 83.5F}), "83.5");
}

struct Luminaire {
    int symmetry = 0;
    int planes = 24;
    double lumens = 2000.0;
    double light_output_ratio = 0.0;  // %; 0: not given
    std::string lamps = "1";
    std::string line_end = "\n";
    Intensity intensity = [](double gamma, double) {
        return 300.0 * std::max(std::cos(gamma), 0.0);
    };
};

/// Planes that a file of this symmetry holds, in its order: the first one and how many.
std::pair<int, int> planes_held(int symmetry, int planes) {
    switch (symmetry) {
        case 1:
            return {0, 1};
        case 2:
            return {0, planes / 2 + 1};
        case 3:
            return {3 * planes / 4, planes / 2 + 1};
        case 4:
            return {0, planes / 4 + 1};
        default:
            return {0, planes};
    }
}

std::string eulumdat(const Luminaire& luminaire) {
    constexpr int step = 5;
    const int angles = 180 / step + 1;
    const double plane_step = 360.0 / luminaire.planes;
    std::vector<std::string> lines = {"Maker",
                                      "1",
                                      fmt::format("{}", luminaire.symmetry),
                                      fmt::format("{}", luminaire.planes),
                                      fmt::format("{}", plane_step),
                                      fmt::format("{}", angles),
                                      fmt::format("{}", step),
                                      "report 5",
                                      "panel",
                                      "4711",
                                      "panel.ldt",
                                      "2020-01-01"};
    for (const char* size : {"600", "600", "50", "580", "580", "0", "0", "0", "0", "100"}) {
        lines.emplace_back(size);
    }
    lines.push_back(fmt::format("{}", luminaire.light_output_ratio));
    lines.insert(lines.end(), {"1.0", "0", "1", luminaire.lamps, "LED",
                               fmt::format("{}", luminaire.lumens), "3000 K", "80", "21.5"});
    lines.insert(lines.end(), 10, "0.5");
    for (int k = 0; k < luminaire.planes; ++k) {
        lines.push_back(fmt::format("{}", k * plane_step));
    }
    for (int k = 0; k < angles; ++k) {
        lines.push_back(fmt::format("{}", k * step));
    }
    const auto [first, held] = planes_held(luminaire.symmetry, luminaire.planes);
    for (int plane = first; plane < first + held; ++plane) {
        for (int k = 0; k < angles; ++k) {
            lines.push_back(
                fmt::format("{:.6f}", luminaire.intensity(glm::radians(1.0 * k * step),
                                                          glm::radians(plane * plane_step))));
        }
    }
    std::string text;
    for (const std::string& line : lines) {
        text += line + luminaire.line_end;
    }
    return text;
}

/// Has neither symmetry; smooth enough for tables of 5 and 15 degrees.
double crooked(double gamma, double c) {
    return 200.0 + 60.0 * std::sin(gamma) * std::cos(c) + 40.0 * std::sin(gamma) * std::sin(c) +
           50.0 * std::cos(gamma);
}

/// crooked(), mirrored as a symmetry wants it.
double symmetric(int symmetry, double gamma, double c) {
    const double x = std::cos(c);
    const double y = std::sin(c);
    const double folded_x = symmetry == 3 || symmetry == 4 ? std::abs(x) : x;
    const double folded_y = symmetry == 2 || symmetry == 4 ? std::abs(y) : y;
    return symmetry == 1 ? crooked(gamma, 0.0) : crooked(gamma, std::atan2(folded_y, folded_x));
}

TEST(Eulumdat, EachSymmetryFillsTheSphere) {
    for (int symmetry = 0; symmetry <= 4; ++symmetry) {
        Luminaire luminaire;
        luminaire.symmetry = symmetry;
        luminaire.intensity = [symmetry](double gamma, double c) {
            return symmetric(symmetry, gamma, c);
        };
        const IesProfile profile = parse_photometry("panel.ldt", eulumdat(luminaire));
        for (int gamma = 0; gamma <= 180; gamma += 20) {
            for (int c = 0; c < 360; c += 15) {
                const double g = glm::radians(1.0 * gamma);
                const double turn = glm::radians(1.0 * c);
                EXPECT_NEAR(profile.candela(towards(g, turn)), 2.0 * symmetric(symmetry, g, turn),
                            1e-4)
                    << "symmetry " << symmetry << ", gamma " << gamma << ", C " << c;
            }
        }
        EXPECT_TRUE(profile.data().notes.empty());
        EXPECT_EQ(profile.data().input_watts, 21.5);
        EXPECT_EQ(profile.data().lamp_lumens, 2000.0);
    }
}

TEST(Eulumdat, TheSameLuminaireAsIesHasTheSameFlux) {
    Luminaire luminaire;
    luminaire.intensity = crooked;
    const IesProfile ldt = parse_photometry("f", eulumdat(luminaire));
    std::string angles;
    std::string values;
    for (int gamma = 0; gamma <= 180; gamma += 5) {
        angles += fmt::format("{} ", gamma);
    }
    angles += "\n";
    for (int c = 0; c <= 360; c += 15) {
        angles += fmt::format("{} ", c);
        for (int gamma = 0; gamma <= 180; gamma += 5) {
            values +=
                fmt::format("{} ", 2.0 * crooked(glm::radians(1.0 * gamma), glm::radians(1.0 * c)));
        }
        values += "\n";
    }
    const IesProfile ies = parse_photometry(
        "f", fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 37 25 1 2 0 0 0\n1 1 20\n{}\n{}",
                         angles, values));
    EXPECT_NEAR(ldt.flux() / ies.flux(), 1.0, 1e-6);
    // 4 pi times the mean intensity: cosine and sine parts have none.
    EXPECT_NEAR(ldt.flux(), 4.0 * pi * 400.0, 0.005 * 4.0 * pi * 400.0);
}

TEST(Eulumdat, FluxDiffersFromWhatIsStatedWithANotice) {
    Luminaire luminaire;  // pi 300 lm/klm
    luminaire.light_output_ratio = 0.1 * 300.0 * pi;
    EXPECT_TRUE(parse_eulumdat("f", eulumdat(luminaire)).data().notes.empty());
    luminaire.light_output_ratio *= 0.9;
    const auto notes = parse_eulumdat("f", eulumdat(luminaire)).data().notes;
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("+11."), std::string::npos) << notes[0];
    EXPECT_NE(notes[0].find("1696 lm"), std::string::npos) << notes[0];
}

TEST(Eulumdat, OddFilesAreReadAsTheyAreMeant) {
    const Luminaire luminaire;
    const double flux = parse_eulumdat("f", eulumdat(luminaire)).flux();
    EXPECT_NEAR(flux, 600.0 * pi, 600.0 * pi * 3e-3);
    for (const char* line_end : {"\r\n", "\r", "  \n", "\r\r\n", "\t\r\n"}) {
        Luminaire other;
        other.line_end = line_end;
        EXPECT_EQ(parse_photometry("f", eulumdat(other)).flux(), flux);
    }
    const std::string text = eulumdat(luminaire);
    EXPECT_EQ(parse_photometry("f", std::regex_replace(text, std::regex(R"((\d)\.(\d))"), "$1,$2"))
                  .flux(),
              flux);
    EXPECT_EQ(parse_photometry("f", "\xEF\xBB\xBF" + std::regex_replace(text, std::regex("Maker"),
                                                                        "H\xE4user \xB0"))
                  .flux(),
              flux);
    Luminaire absolute;
    absolute.lamps = "-4";
    EXPECT_EQ(parse_photometry("f", eulumdat(absolute)).flux(), flux);
    EXPECT_EQ(parse_photometry("f", text + "\n\n\x1A").flux(), flux);
    EXPECT_EQ(parse_photometry("f", text.substr(0, text.find_last_of('0') + 1) + "\x1A").flux(),
              flux);
}

TEST(Eulumdat, AGltfLightTakesIt) {
    const TemporaryFolder folder;
    SceneSettings settings;
    settings.ies = {"desk=" + folder.write("panel.ldt", eulumdat({}))};
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    builder.add_node({{"name", "desk"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const Scene scene = builder.load(settings);
    ASSERT_EQ(scene.punctual_lights.size(), 1U);
    EXPECT_NEAR(place_light(scene, scene.punctual_lights[0]).flux().g, 600.0 * pi, 6.0);
}

std::string ldt_error(const std::string& text) {
    try {
        (void)parse_photometry("f", text);
    } catch (const SceneError& error) {
        return error.json_path() + ": " + error.reason();
    }
    return "none";
}

/// Replaces one line (from 1).
std::string with_line(std::size_t number, const std::string& line) {
    std::string text = eulumdat({});
    std::size_t at = 0;
    for (std::size_t k = 1; k < number; ++k) {
        at = text.find('\n', at) + 1;
    }
    return text.replace(at, text.find('\n', at) - at, line);
}

TEST(Eulumdat, TextStandsWhereTheLightDoesNotDependOnIt) {
    const double flux = parse_eulumdat("f", eulumdat({})).flux();
    const IesProfile profile = parse_eulumdat("f", with_line(32, "2x36 W"));
    EXPECT_EQ(profile.flux(), flux);
    ASSERT_EQ(profile.data().notes.size(), 1U);
    EXPECT_EQ(profile.data().notes[0], "the power is not a number: \"2X36W\"");
    const IesProfile latin = parse_eulumdat("f", with_line(32, "f\xFCr 36 W"));
    ASSERT_EQ(latin.data().notes.size(), 1U);
    EXPECT_EQ(latin.data().notes[0], "the power is not a number: \"F?R36W\"")
        << "answers are UTF-8";
    for (const std::size_t line : {13U, 15U, 22U, 23U, 32U, 33U, 42U}) {
        const IesProfile dashed = parse_eulumdat("f", with_line(line, "-"));
        EXPECT_EQ(dashed.flux(), flux) << line;
        EXPECT_TRUE(dashed.data().notes.empty()) << line;
    }
}

TEST(Eulumdat, ErrorsNameTheLineAndTheReason) {
    EXPECT_EQ(ldt_error(with_line(3, "7")), "line 3: the symmetry is 7, not in [0, 4]");
    EXPECT_EQ(ldt_error(with_line(4, "1000000")),
              "line 12: 1000000 x 37 values; the limit is 1048576");
    EXPECT_EQ(ldt_error(with_line(6, "0")),
              "line 6: the number of angles in a plane is 0, not in [2, 1048576]");
    EXPECT_EQ(ldt_error(with_line(24, "-1")), "line 24: the conversion factor is -1, below 0");
    EXPECT_EQ(ldt_error(with_line(29, "0")),
              "line 29: the flux of its first lamp set is 0, so that its cd/klm are dark");
    EXPECT_EQ(ldt_error(with_line(29, "many")),
              "line 29: the flux of the lamps is not a number: \"MANY\"");
    EXPECT_EQ(ldt_error(with_line(44, "0")),
              "line 44: a C angle 0 is not above the one before it, 0");
    EXPECT_EQ(ldt_error(with_line(110, "-300")),
              "line 110: a candela value is -600: more than noise");
    const std::string text = eulumdat({});
    EXPECT_NE(ldt_error(text.substr(0, text.size() - 40)).find("the file ends where an intensity"),
              std::string::npos);
    EXPECT_NE(ldt_error(text + "5\n").find("more numbers follow"), std::string::npos);
    Luminaire odd;
    odd.symmetry = 4;
    odd.planes = 6;
    EXPECT_NE(ldt_error(eulumdat(odd)).find("6 C planes do not fit symmetry 4"), std::string::npos);
    EXPECT_EQ(ldt_error(std::string((16U << 20U) + 1, 'x')),
              "line 1: more than 16777216 bytes, the limit of photometric files");
}

/// Millimetres, the length across C0; of a round opening the width is 0.
TEST(Eulumdat, HasTheSizeOfItsLuminousPart) {
    const std::string text = eulumdat({});
    const IesProfile::Opening square = parse_eulumdat("a.ldt", text).data().opening;
    EXPECT_DOUBLE_EQ(square.length, 0.58);
    EXPECT_DOUBLE_EQ(square.width, 0.58);
    EXPECT_FALSE(square.round);
    EXPECT_NEAR(square.projected_area({0, 0, -1}), 0.58 * 0.58, 1e-12);
    EXPECT_NEAR(square.projected_area({0.6, 0, -0.8}), 0.8 * 0.58 * 0.58, 1e-12);
    std::string long_one = text;
    const std::size_t at = long_one.find("580\n580\n0\n0\n0\n0\n");
    ASSERT_NE(at, std::string::npos);
    long_one.replace(at, 16, "1200\n100\n50\n60\n0\n0\n");
    const IesProfile::Opening tube = parse_eulumdat("a.ldt", long_one).data().opening;
    EXPECT_DOUBLE_EQ(tube.width, 1.2);   // along C90
    EXPECT_DOUBLE_EQ(tube.length, 0.1);  // along C0
    EXPECT_NEAR(tube.projected_area({1, 0, 0}), 0.05 * 1.2, 1e-12);
    EXPECT_NEAR(tube.projected_area({0, 1, 0}), 0.06 * 0.1, 1e-12);
    EXPECT_NEAR(tube.projected_area({-1, 0, 0}), 0.0, 1e-12);
    std::string round = text;
    round.replace(at, 8, "200\n0\n");
    const IesProfile::Opening disc = parse_eulumdat("a.ldt", round).data().opening;
    EXPECT_TRUE(disc.round);
    EXPECT_NEAR(disc.projected_area({0, 0, -1}), pi * 0.01, 1e-12);
}

/// LM-63: feet or metres, the width across the plane of 0 degrees, negative ones are diameters.
TEST(IesOpening, HasTheSizeOfItsLuminousPart) {
    const auto opening = [](const std::string& size) {
        return parse_ies("a.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 1 1 " + size +
                                      "\n1 1 10\n0 90\n0\n100 100\n")
            .data()
            .opening;
    };
    const IesProfile::Opening metres = opening("2 0.3 1.2 0");
    EXPECT_DOUBLE_EQ(metres.width, 0.3);
    EXPECT_DOUBLE_EQ(metres.length, 1.2);
    EXPECT_NEAR(opening("1 1 1 0").length, 0.3048, 1e-12);
    const IesProfile::Opening can = opening("2 -0.2 0 0.1");
    EXPECT_TRUE(can.round);
    EXPECT_NEAR(can.projected_area({0, 0, -1}), pi * 0.01, 1e-12);
    EXPECT_NEAR(can.projected_area({0.6, 0.8, 0}), 0.1 * 0.2, 1e-12);
    EXPECT_EQ(opening("2 0 0 0").projected_area({0, 0, -1}), 0.0);
}

}  // namespace
}  // namespace raybundle::test
