// SPDX-License-Identifier: Apache-2.0
// Images of the surroundings that other programs write.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "case_files.h"
#include "gltf_builder.h"
#include "scene/light/environment_map.h"

namespace raybundle::test {
namespace {

Scene below_sky(const std::string& image) {
    SceneSettings settings;
    settings.daylight.environment = image;
    const std::string bytes = case_bytes("sky/" + image);
    settings.daylight.environment_bytes.assign(bytes.begin(), bytes.end());
    return load_gltf(case_path("sky/floor.gltf"), settings);
}

EquirectangularImage read_image(const std::string& bytes) {
    return read_equirectangular(
        "sky", {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

std::string refused(const std::string& bytes) {
    try {
        (void)read_image(bytes);
    } catch (const SceneError& error) {
        return error.reason();
    }
    return "none";
}

/// Illuminance of a level floor by the sky and its suns, lx: midpoints of 400 x 400 directions.
glm::dvec3 illuminance(const Scene& scene) {
    constexpr int steps = 400;
    constexpr double pi = std::numbers::pi;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < steps; ++i) {
        const double theta = 0.5 * pi * (i + 0.5) / steps;
        for (int k = 0; k < steps; ++k) {
            const double phi = 2.0 * pi * (k + 0.5) / steps;
            sum += std::sin(theta) * std::cos(theta) *
                   sky_towards(scene, {std::sin(theta) * std::cos(phi), std::cos(theta),
                                       std::sin(theta) * std::sin(phi)});
        }
    }
    sum *= 0.5 * pi / steps * 2.0 * pi / steps;
    for (const PunctualLight& light : scene.punctual_lights) {
        sum += glm::dvec3(light.intensity) * std::max(0.0, place_light(scene, light).axes[2].y);
    }
    return sum;
}

TEST(CasesSky, RadiancePicturesGiveTheRightIlluminance) {
    for (const char* file :
         {"00_normal.hdr", "03_plusY_plusX.hdr", "07_exposure2.hdr", "09_xyze.hdr"}) {
        const glm::dvec3 e = illuminance(below_sky(file));
        // At the horizon the image is interpolated; XYZE has eight bits for each channel.
        EXPECT_NEAR(e.g, 402.1, 3.0) << file;
        EXPECT_NEAR(e.r, e.g, 0.02 * e.g) << file;
        EXPECT_NEAR(e.b, e.g, 0.02 * e.g) << file;
    }
}

TEST(CasesSky, ASunThatIsInfiniteInHalfFloatsIsTheirLargestValue) {
    const Scene scene = below_sky("inf_sun.exr");
    EXPECT_TRUE(has_notice(scene, "'inf_sun.exr': infinite pixels are read as 65504: 1"));
    ASSERT_EQ(scene.punctual_lights.size(), 1U);
    // One pixel of 64 x 32 in row 4: 65504 less what is left of it in the sky.
    const double row = std::numbers::pi / 32.0;
    const double solid_angle = row * (std::cos(4 * row) - std::cos(5 * row));
    EXPECT_NEAR(illuminance(scene).g - 402.1, 65504.0 * solid_angle * std::cos(4.5 * row), 10.0);
}

/// A flat picture: `pixel(x, y)` of what is seen, stored as the resolution line says.
std::string radiance_file(const std::string& header, const std::string& resolution, int scanlines,
                          int length, const std::function<std::string(int, int)>& pixel) {
    std::string bytes = "#?RADIANCE\n" + header + "\n" + resolution + "\n";
    for (int i = 0; i < scanlines; ++i) {
        for (int k = 0; k < length; ++k) {
            bytes += pixel(i, k);
        }
    }
    return bytes;
}

std::string rgbe(int r, int g, int b) {
    return {static_cast<char>(r), static_cast<char>(g), static_cast<char>(b), '\x88'};
}

const std::string rgbe_format = "FORMAT=32-bit_rle_rgbe\n";

/// The pixel at column x and row y of an 8 x 4 image has the red value 10 x + y + 1.
TEST(CasesSky, AllEightOrientationsAreObeyed) {
    for (const bool rows : {true, false}) {
        for (const bool up : {false, true}) {
            for (const bool left : {false, true}) {
                const std::string y = up ? "+Y 4" : "-Y 4";
                const std::string x = left ? "-X 8" : "+X 8";
                const auto stored = [&](int i, int k) {
                    const int row = rows ? i : k;
                    const int column = rows ? k : i;
                    return rgbe(10 * (left ? 7 - column : column) + (up ? 3 - row : row) + 1, 0, 0);
                };
                const EquirectangularImage image =
                    read_image(radiance_file(rgbe_format, rows ? y + " " + x : x + " " + y,
                                             rows ? 4 : 8, rows ? 8 : 4, stored));
                ASSERT_EQ(image.width, 8);
                ASSERT_EQ(image.height, 4);
                for (int row = 0; row < 4; ++row) {
                    for (int column = 0; column < 8; ++column) {
                        EXPECT_EQ(image.pixels[image.index(column, row)].r,
                                  static_cast<float>(10 * column + row + 1));
                    }
                }
            }
        }
    }
}

TEST(CasesSky, ExposureAndColourCorrectionAreProducts) {
    const auto first = [](const std::string& header) {
        return read_image(radiance_file(header, "-Y 2 +X 4", 2, 4,
                                        [](int, int) { return rgbe(120, 120, 120); }))
            .pixels[0];
    };
    EXPECT_EQ(first(rgbe_format), glm::vec3(120));
    EXPECT_EQ(first("EXPOSURE=2\nEXPOSURE= 3.0e0\n" + rgbe_format), glm::vec3(20));
    EXPECT_EQ(first("COLORCORR= 1 2 4\nCOLORCORR=2 2 2\nEXPOSURE=0.5\n" + rgbe_format),
              glm::vec3(120, 60, 30));
    EXPECT_EQ(refused(radiance_file("EXPOSURE=0\n" + rgbe_format, "-Y 2 +X 4", 2, 4,
                                    [](int, int) { return rgbe(1, 1, 1); })),
              "EXPOSURE=0: a number above 0 expected");
    // White stays white; the green of a wider space is beyond that of Rec. 709.
    const std::string wide = "PRIMARIES= .708 .292 .170 .797 .131 .046 .3127 .3290\n";
    EXPECT_LT(glm::distance(first(wide + rgbe_format), glm::vec3(120)), 0.01F);
    const glm::vec3 green =
        read_image(radiance_file(wide + rgbe_format, "-Y 2 +X 4", 2, 4, [](int, int) {
            return rgbe(0, 120, 0);
        })).pixels[0];
    EXPECT_NEAR(green.g, 120.0F * 1.1329F, 0.2F);  // ITU-R BT.2087
    EXPECT_EQ(green.r, 0.0F);
}

/// Programs write GAMMA=1 of linear pictures, and others of what may be linear or not.
TEST(CasesSky, HeadersOfOtherProgramsAreReadOrNamed) {
    const auto read = [](const std::string& header) {
        return read_image(radiance_file(header + rgbe_format, "-Y 2 +X 4", 2, 4,
                                        [](int, int) { return rgbe(120, 120, 120); }));
    };
    EXPECT_TRUE(read("# Made by a program\nSOFTWARE=x\nVIEW= -vtv\nGAMMA=1.0\n").notes.empty());
    const EquirectangularImage image = read("GAMMA=0.4545\nPRIMARIES=0 0 0 0 0 0 0 0\n");
    EXPECT_EQ(image.pixels[0], glm::vec3(120));
    ASSERT_EQ(image.notes.size(), 2U);
    EXPECT_EQ(image.notes[0], "GAMMA=0.4545 is ignored: its numbers are read as linear");
    // Of a program whose numbers have decimal commas.
    EXPECT_EQ(refused(radiance_file("EXPOSURE=2,5\n" + rgbe_format, "-Y 2 +X 4", 2, 4,
                                    [](int, int) { return rgbe(1, 1, 1); })),
              "EXPOSURE=2,5: a number above 0 expected");
}

/// A flat picture whose first pixel looks like the beginning of a run.
TEST(CasesSky, DarkPixelsAreNotTakenForRuns) {
    const EquirectangularImage image =
        read_image(radiance_file(rgbe_format, "-Y 8 +X 16", 8, 16, [](int i, int k) {
            return i == 0 && k == 0 ? std::string("\x02\x02\x02\x80", 4) : rgbe(9, 9, 9);
        }));
    EXPECT_EQ(image.pixels[0], glm::vec3(std::ldexp(2.0F, -8)));
    EXPECT_EQ(image.pixels[127], glm::vec3(9));
}

/// Copies as text, between systems, have another byte before each line feed.
TEST(CasesSky, CopiesAsTextAreRefused) {
    std::string bytes = radiance_file(rgbe_format, "-Y 4 +X 8", 4, 8,
                                      [](int, int k) { return rgbe(k == 3 ? '\n' : 20, 20, 20); });
    for (std::size_t at = bytes.find('\n'); at != std::string::npos;
         at = bytes.find('\n', at + 2)) {
        bytes.insert(at, "\r");
    }
    EXPECT_EQ(refused(bytes).substr(0, 18), "was copied as text");
}

TEST(CasesSky, BothKindsOfRunLengthsAreRead) {
    const std::string resolution = "-Y 4 +X 8\n";
    std::string old = "#?RGBE\n" + rgbe_format + "\n" + resolution;
    std::string recent = old;
    for (int i = 0; i < 4; ++i) {
        old += rgbe(50, 60, 70) + std::string("\x01\x01\x01\x06", 4) + rgbe(1, 2, 3);
        recent += std::string("\x02\x02\x00\x08", 4);
        for (const int value : {50, 60, 70, 0x88}) {
            const int last = value == 0x88 ? value : value / 10 - 4;
            recent += {'\x87', static_cast<char>(value), '\x01', static_cast<char>(last)};
        }
    }
    for (const std::string& bytes : {old, recent}) {
        const EquirectangularImage image = read_image(bytes);
        EXPECT_EQ(image.pixels[image.index(6, 3)], glm::vec3(50, 60, 70));
        EXPECT_EQ(image.pixels[image.index(7, 3)], glm::vec3(1, 2, 3));
        for (const std::size_t cut : {std::size_t{1}, std::size_t{9}, bytes.size() / 3}) {
            EXPECT_EQ(refused(bytes.substr(0, bytes.size() - cut)).substr(0, 17),
                      "cannot be decoded");
        }
    }
}

struct Exr {
    OIIO::ImageSpec spec;
    std::vector<float> values;

    Exr(int width, int height, int channels)
        : spec(width, height, channels, OIIO::TypeDesc::FLOAT) {
        values.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                          static_cast<std::size_t>(channels),
                      1.0F);
    }

    [[nodiscard]] std::string bytes() const {
        const TemporaryFolder folder;
        const std::string path = folder.write("x.exr", "");
        const auto out = OIIO::ImageOutput::create("openexr");
        EXPECT_TRUE(out->open(path, spec));
        EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
        EXPECT_TRUE(out->close());
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    }
};

TEST(CasesSky, PixelsWithoutANumberAreMended) {
    Exr exr(8, 4, 3);
    exr.values[23] = 7.0F;
    for (const std::size_t i : {30U, 31U, 32U}) {
        exr.values[i] = std::numeric_limits<float>::quiet_NaN();
    }
    exr.values[60] = std::numeric_limits<float>::infinity();
    exr.values[70] = -std::numeric_limits<float>::infinity();
    const EquirectangularImage image = read_image(exr.bytes());
    EXPECT_EQ(image.pixels[10], glm::vec3(1.0F));
    EXPECT_EQ(image.pixels[20], glm::vec3(7.0F, 1.0F, 1.0F));
    EXPECT_EQ(image.pixels[23], glm::vec3(1.0F));
    ASSERT_EQ(image.notes.size(), 2U);
    EXPECT_EQ(image.notes[0], "pixels without a number are read as their neighbours: 2");
    EXPECT_EQ(image.notes[1], "infinite pixels are read as 7: 1");
}

TEST(CasesSky, OtherLayoutsAreRefusedAndNotStretched) {
    // Its shape alone does not say so: the attribute envmap does, 1 of a byte.
    std::string cube = Exr(64, 32, 3).bytes();
    cube.insert(8, std::string("envmap\0envmap\0\x01\0\0\0\x01", 19));
    EXPECT_EQ(refused(cube).substr(0, 13), "is a cube map");
    const auto layout = [](int width, int height) {
        return refused(Exr(width, height, 3).bytes());
    };
    EXPECT_EQ(layout(16, 16),
              "has 16 x 16 pixels (as angular maps and light probes have): an "
              "equirectangular image is twice as wide as high");
    for (const auto& [width, height] : {std::pair(8, 48), {48, 8}, {16, 12}, {12, 16}}) {
        EXPECT_NE(layout(width, height).find("as cube maps have"), std::string::npos);
    }
    EXPECT_NE(layout(64, 16).find("twice as wide"), std::string::npos);
    EXPECT_EQ(layout(64, 31), "none");
    EXPECT_EQ(read_image(Exr(64, 28, 3).bytes()).notes.size(), 1U);
}

/// A data window that is a part of the picture, or larger than it.
TEST(CasesSky, WindowsOfOpenExrArePlaced) {
    Exr part(8, 8, 3);
    part.spec.x = 4;
    part.spec.y = 2;
    part.spec.full_width = 32;
    part.spec.full_height = 16;
    const EquirectangularImage image = read_image(part.bytes());
    ASSERT_EQ(image.width, 32);
    EXPECT_EQ(image.pixels[image.index(4, 2)], glm::vec3(1.0F));
    EXPECT_EQ(image.pixels[image.index(3, 2)], glm::vec3(0.0F));
    EXPECT_EQ(image.pixels[image.index(12, 9)], glm::vec3(0.0F));
}

TEST(CasesSky, ChannelsAreFoundByTheirNames) {
    Exr layered(8, 4, 5);
    layered.spec.channelnames = {"Z", "sky.A", "sky.B", "sky.G", "sky.R"};
    for (std::size_t i = 0; i < layered.values.size(); ++i) {
        layered.values[i] = static_cast<float>(i % 5);
    }
    const std::string bytes = layered.bytes();
    EXPECT_EQ(read_image(bytes).pixels[3], glm::vec3(4, 3, 2));
    Exr grey(8, 4, 2);
    grey.spec.channelnames = {"Y", "A"};
    EXPECT_EQ(read_image(grey.bytes()).pixels[0], glm::vec3(1.0F));
    for (const std::vector<std::string>& names : {std::vector<std::string>{"a", "r", "g", "b"},
                                                  {"x", ".R", ".G", ".B"},
                                                  {"Z", "red", "green", "blue"},
                                                  {"channel3", "R", "G", "B"}}) {
        Exr spelt(8, 4, 4);
        spelt.spec.channelnames = names;
        for (std::size_t i = 0; i < spelt.values.size(); ++i) {
            spelt.values[i] = static_cast<float>(i % 4);
        }
        EXPECT_EQ(read_image(spelt.bytes()).pixels[0], glm::vec3(1, 2, 3)) << names[1];
    }
    Exr chroma(8, 4, 3);
    chroma.spec.channelnames = {"BY", "RY", "Y"};
    EXPECT_EQ(refused(chroma.bytes()), "has no channels R, G and B, but Y, BY, RY");
    Exr other(8, 4, 2);
    other.spec.channelnames = {"u", "v"};
    EXPECT_EQ(refused(other.bytes()), "has no channels R, G and B, but u, v");
    Exr wide(8, 4, 3);
    const float xy[] = {0.7347F, 0.2653F, 0.0F, 1.0F, 0.0001F, -0.077F, 0.32168F, 0.33767F};
    wide.spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), xy);
    EXPECT_LT(glm::distance(read_image(wide.bytes()).pixels[0], glm::vec3(1.0F)), 1e-3F);
}

/// Depth and coverage are no light, and a file may have parts.
TEST(CasesSky, TheFirstPartWithColoursIsRead) {
    Exr depth(8, 4, 1);
    for (const char* name : {"Z", "depth", "view.Depth", "A"}) {
        depth.spec.channelnames = {name};
        EXPECT_EQ(refused(depth.bytes()), std::string("has no channels R, G and B, but ") + name);
    }
    depth.spec.channelnames = {"sky"};
    EXPECT_EQ(read_image(depth.bytes()).pixels[0], glm::vec3(1.0F));
    const TemporaryFolder folder;
    const std::string path = folder.write("x.exr", "");
    OIIO::ImageSpec parts[] = {OIIO::ImageSpec(16, 8, 1, OIIO::TypeDesc::FLOAT),
                               OIIO::ImageSpec(16, 8, 3, OIIO::TypeDesc::HALF)};
    parts[0].channelnames = {"Z"};
    parts[0].attribute("name", "depth");
    parts[1].attribute("name", "beauty");
    const std::vector<float> values(16 * 8 * 3, 5.0F);
    const auto out = OIIO::ImageOutput::create("openexr");
    ASSERT_TRUE(out->open(path, 2, parts));
    EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    ASSERT_TRUE(out->open(path, parts[1], OIIO::ImageOutput::AppendSubimage));
    EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    EXPECT_TRUE(out->close());
    std::ifstream in(path, std::ios::binary);
    const EquirectangularImage image =
        read_image({std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
    EXPECT_EQ(image.width, 16);
    EXPECT_EQ(image.pixels[9], glm::vec3(5.0F));
}

}  // namespace
}  // namespace raybundle::test
