// SPDX-License-Identifier: Apache-2.0
// `raybundle render` with the methods that need no GL context, on a machine made to have none.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

class Render : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / ("raybundle_render_" + std::string(GetParam()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// Exit status of render with these arguments, without any EGL vendor.
    static int render(const std::string& arguments) {
        const std::string command =
            "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent " RAYBUNDLE_EXECUTABLE
            " render --log-level off " RAYBUNDLE_SCENES "/cornell_box.gltf " +
            arguments + " 2>/dev/null";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    [[nodiscard]] std::string file(const char* name) const { return (folder_ / name).string(); }

    fs::path folder_;
};

/// Pixels of a picture of 40 x 30, RGB; empty where it cannot be read.
std::vector<float> pixels_of(const std::string& path) {
    std::vector<float> pixels(40 * 30 * 3);
    const auto input = OIIO::ImageInput::open(path);
    const bool good = input && input->spec().width == 40 && input->spec().height == 30 &&
                      input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data());
    return good ? pixels : std::vector<float>();
}

std::string text_of(const std::string& path) {
    std::ifstream stream(path);
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST_P(Render, NeedsNoGlContextAndRepeatsItsBits) {
    const std::string arguments =
        std::string("--method ") + GetParam() + " --iterations 8 --seed 3 --size 40x30 -o ";
    ASSERT_EQ(render(arguments + file("a.exr") + " --stats " + file("a.json")), 0);
    ASSERT_EQ(render(arguments + file("b.exr")), 0);
    ASSERT_EQ(render(arguments + file("a.png")), 0);
    const std::vector<float> pixels = pixels_of(file("a.exr"));
    ASSERT_FALSE(pixels.empty());
    // The lamp is seen at the top of the picture: row 0 is at the top.
    float largest_above = 0.0F;
    float largest_below = 0.0F;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        float& largest = i < pixels.size() / 2 ? largest_above : largest_below;
        largest = std::max(largest, pixels[i]);
    }
    EXPECT_GT(largest_above, 500.0F);
    EXPECT_LT(largest_below, 100.0F);
    EXPECT_GT(largest_below, 0.0F);
    EXPECT_TRUE(pixels == pixels_of(file("b.exr")));
    EXPECT_NE(text_of(file("a.json")).find("\"iterations\": 8"), std::string::npos);
    EXPECT_GT(fs::file_size(file("a.png")), 100U);
}

INSTANTIATE_TEST_SUITE_P(Methods, Render, testing::Values("path", "single-ray", "photon-map"));
INSTANTIATE_TEST_SUITE_P(HeavyMethods, Render,
                         testing::Values("path-reuse", "ray-cast", "light", "bidirectional",
                                         "metropolis"));

class RenderFailure : public Render {};

/// The environment of these tests really has no GL, and a failure leaves no file.
TEST_P(RenderFailure, OtherMethodsNeedAContext) {
    EXPECT_EQ(render(std::string("--method ") + GetParam() + " --iterations 1 --size 8x8 -o " +
                     file("x.exr")),
              4);
    EXPECT_EQ(render("--method nonsense --iterations 1 -o " + file("x.exr")), 2);
    EXPECT_FALSE(fs::exists(file("x.exr")));
}

/// What is wrong with an output or a script is told before the scene is read: here there is none.
TEST_P(RenderFailure, IsToldBeforeWorkBegins) {
    const auto render_nothing = [](const std::string& arguments) {
        const std::string command =
            RAYBUNDLE_EXECUTABLE " render --log-level off /nonexistent/scene.glb --iterations 1 " +
            arguments + " 2>/dev/null";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    EXPECT_EQ(render_nothing("--method path -o " + file("x.exr")), 3) << "no scene";
    EXPECT_EQ(render_nothing("-o /nonexistent/x.exr"), 1);
    EXPECT_EQ(render_nothing("-o " + file("x.exr") + " --stats /nonexistent/x.json"), 1);
    std::ofstream(file("broken.json")) << "{\"frames\": 2, \"keys\": [";
    EXPECT_EQ(render_nothing("--script " + file("broken.json") + " -o " + file("f_%d.png")), 2);
    std::ofstream(file("good.json")) << "{\"frames\": 2, \"keys\": []}";
    EXPECT_EQ(render_nothing("--script " + file("good.json") + " -o " + file("f.png")), 2);
    EXPECT_EQ(render_nothing("--script " + file("good.json") + " -o " + file("f_%d.png")), 3);
}

INSTANTIATE_TEST_SUITE_P(Gpu, RenderFailure, testing::Values("combined"));

/// A folder of scenes is served with one configuration, and not every scene has air.
TEST(Inspect, TakesOptionsOfTheAirWhereThereIsNone) {
    const std::string output = (fs::path(testing::TempDir()) / "raybundle_inspect.txt").string();
    const std::string command = RAYBUNDLE_EXECUTABLE
                                " inspect --fog-albedo 0.5 --fog-anisotropy 0.3 " RAYBUNDLE_SCENES
                                "/cornell_box.gltf > " +
                                output + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    const std::string text = text_of(output);
    EXPECT_NE(text.find("fogAlbedo and fogAnisotropy change nothing"), std::string::npos) << text;
    fs::remove(output);
}

/// Frames of a file whose animation bends a flag, against files that have it so from the start.
class ScriptedFlag : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / "raybundle_scripted_flag";
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        text_ = text_of(RAYBUNDLE_SCENES "/../tests/cases/animation/flag.gltf");
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// Pictures of as many frames; `key` is added to a camera. rotation: of the joint in the file.
    std::vector<std::vector<float>> frames(int count, const std::string& rotation,
                                           const std::string& keys) {
        std::string text = text_;
        const std::string rest = "0.0, 0.0, 0.0, 1.0";
        text.replace(text.find(rest), rest.size(), rotation);
        std::ofstream(folder_ / "flag.gltf") << text;
        std::ofstream(folder_ / "script.json")
            << "{\"framesPerSecond\": 1, \"frames\": " << count
            << ", \"keys\": [{\"time\": 0, \"camera\": {\"eye\": [1.5, 1.7, 6], \"target\": "
               "[0, 1.2, 0], \"verticalFov\": 0.6}}"
            << keys << "]}";
        const std::string at = folder_.string();
        const std::string command =
            RAYBUNDLE_EXECUTABLE " render --log-level off " + at + "/flag.gltf --script " + at +
            "/script.json --iterations 64 --patch-size 0.15 --size 40x30 -o " + at + "/f_%d.exr";
        EXPECT_EQ(std::system(command.c_str()), 0);
        std::vector<std::vector<float>> pictures;
        for (int frame = 0; frame < count; ++frame) {
            pictures.push_back(pixels_of(at + "/f_" + std::to_string(frame) + ".exr"));
            EXPECT_FALSE(pictures.back().empty());
        }
        return pictures;
    }

    /// Root of the mean square, relative to that of the second; lamps, which all have, left out.
    static double difference(const std::vector<float>& a, const std::vector<float>& b) {
        double sum = 0.0;
        double square = 0.0;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
            if (a[i] < 500.0F && b[i] < 500.0F) {
                sum += double{a[i] - b[i]} * double{a[i] - b[i]};
                square += double{b[i]} * double{b[i]};
            }
        }
        return std::sqrt(sum / square);
    }

  private:
    fs::path folder_;
    std::string text_;
};

TEST_F(ScriptedFlag, IsLitAsInAFileInThatPose) {
    const std::string rest = "0.0, 0.0, 0.0, 1.0";
    const auto played = frames(3, rest,
                               R"(, {"time": 1, "animation": "bow", "seconds": 1, "speed": 0},
             {"time": 2, "animation": "bow", "seconds": 0, "speed": 0})");
    const auto bent = frames(1, "0.38268343, 0.0, 0.0, 0.92387953", "");
    const double apart = difference(played[0], bent[0]);
    const double noise = difference(played[1], bent[0]);
    EXPECT_GT(apart, 0.3);
    EXPECT_LT(noise, 0.15 * apart);  // of two solutions: their vertices differ by rounding
    EXPECT_EQ(played[2], played[0]);
}

}  // namespace
