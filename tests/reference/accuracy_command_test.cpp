// SPDX-License-Identifier: Apache-2.0
// `raybundle accuracy` with the methods that need no GL context, on a machine made to have none.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace {

namespace fs = std::filesystem;

class AccuracyCommand : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ =
            fs::path(testing::TempDir()) / (std::string("raybundle_accuracy_") + test->name());
        fs::remove_all(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// Exit status of accuracy with these arguments, without any EGL vendor. By its clock 10 ms
    /// pass with each iteration, on any machine.
    [[nodiscard]] int accuracy(const std::string& arguments) const {
        const std::string command =
            "RAYBUNDLE_TEST_CLOCK_MS=10 "
            "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent " RAYBUNDLE_EXECUTABLE
            " accuracy --log-level off " RAYBUNDLE_SCENES "/cornell_box.gltf -o '" +
            folder_.string() + "' " + arguments + " >/dev/null 2>&1";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    [[nodiscard]] nlohmann::json json(const char* name) const {
        std::ifstream stream(folder_ / name);
        return nlohmann::json::parse(stream, nullptr, false);
    }
    [[nodiscard]] bool has(const char* name) const {
        return fs::exists(folder_ / name) && fs::file_size(folder_ / name) > 100;
    }

    fs::path folder_;
};

const std::string small = "--size 20x16 --seconds 0.4 --reference-seconds 3 ";

TEST_F(AccuracyCommand, MeasuresCurvesAgainstAReference) {
    ASSERT_EQ(accuracy(small + "--methods path,single-ray --repeats 2"), 0);
    for (const char* name :
         {"accuracy.json", "index.html", "error_over_time.svg", "error_over_iterations.svg",
          "estimate_path.svg", "picture_path.png", "error_path.png", "picture_reference.png",
          "reference_area.exr", "reference_area.json"}) {
        EXPECT_TRUE(has(name)) << name;
    }
    for (const auto& entry : fs::directory_iterator(folder_)) {
        EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
    }
    const nlohmann::json found = json("accuracy.json");
    ASSERT_EQ(found["curves"].size(), 2U);
    const double noise = found["reference"]["relativeError"].get<double>();
    for (const auto& curve : found["curves"]) {
        double before = 0.0;
        for (const auto& point : curve["points"]) {
            EXPECT_GT(point["seconds"].get<double>(), before);
            before = point["seconds"].get<double>();
            const double error = point["relRMSE"].get<double>();
            EXPECT_TRUE(!point["resolved"].get<bool>() || error >= 4.0 * noise);
        }
        EXPECT_GE(curve["points"].size(), 2U);
    }
    // More of it is better.
    const auto& points = found["curves"][0]["points"];
    EXPECT_LT(points.back()["relRMSE"].get<double>(), points.front()["relRMSE"].get<double>());
}

TEST_F(AccuracyCommand, KeepsItsReference) {
    ASSERT_EQ(accuracy(small + "--methods path"), 0);
    const auto first = json("reference_area.json");
    ASSERT_EQ(accuracy(small + "--methods ray-cast"), 0);  // coarse enough for what there is
    EXPECT_EQ(json("reference_area.json"), first);
    // One of another size is made anew.
    ASSERT_EQ(accuracy("--size 10x8 --seconds 0.2 --reference-seconds 1 --methods ray-cast"), 0);
    EXPECT_EQ(json("reference_area.json")["of"]["size"], (nlohmann::json{10, 8}));
}

TEST_F(AccuracyCommand, ComparesWithAFileThatIsNamed) {
    ASSERT_EQ(accuracy(small + "--methods path"), 0);
    fs::copy_file(folder_ / "reference_area.exr", folder_ / "mine.exr");
    const std::string mine = " --reference '" + (folder_ / "mine.exr").string() + "'";
    ASSERT_EQ(accuracy(small + "--methods path" + mine), 0);
    EXPECT_TRUE(json("accuracy.json")["reference"]["relativeError"].is_null());
    EXPECT_EQ(accuracy("--size 10x8 --seconds 0.2 --methods path" + mine), 1);
    EXPECT_EQ(accuracy(small + "--methods path --reference /nonexistent.exr"), 1);
}

TEST_F(AccuracyCommand, SaysWhatIsWrong) {
    EXPECT_EQ(accuracy("--methods nonsense"), 2);
    EXPECT_EQ(accuracy("--methods path,path"), 2);
    EXPECT_EQ(accuracy("--methods path --size 0x5"), 2);
    EXPECT_EQ(accuracy("--methods path --knobs"), 2);
    EXPECT_EQ(accuracy("--methods path --repeats 0"), 2);
    EXPECT_EQ(accuracy("--methods combined"), 4);
    EXPECT_EQ(accuracy("--methods path --camera nobody"), 2);
    EXPECT_FALSE(fs::exists(folder_ / "accuracy.json"));
    std::ofstream(folder_.string()) << "a file where the folder should be";
    EXPECT_EQ(accuracy(small + "--methods path"), 1);
}

}  // namespace
