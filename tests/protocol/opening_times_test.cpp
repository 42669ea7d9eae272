// SPDX-License-Identifier: Apache-2.0
#include "app/opening_times.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace raybundle {
namespace {

std::string file_of(const std::string& name, std::size_t bytes) {
    const std::string path = (std::filesystem::path(testing::TempDir()) / name).string();
    std::ofstream(path) << std::string(bytes, 'x');
    return path;
}

TEST(OpeningTimes, SayNothingBeforeTheFirst) {
    EXPECT_FALSE(OpeningTimes().expected(file_of("any.glb", 10)).has_value());
}

/// Reading follows the size of the file; shaders take as long for a large one.
TEST(OpeningTimes, GrowByWhatReadingTakes) {
    const std::string small = file_of("small.glb", 1000);
    const std::string large = file_of("large.glb", 20'000);
    OpeningTimes times;
    times.note(small, 102.0, 100.0);
    EXPECT_DOUBLE_EQ(times.expected(small).value(), 102.0);
    EXPECT_DOUBLE_EQ(times.expected(large).value(), 140.0);
    times.note(large, 90.0, 50.0);
    EXPECT_DOUBLE_EQ(times.expected(large).value(), 90.0);
    EXPECT_DOUBLE_EQ(times.expected(small).value(), 102.0);
}

TEST(OpeningTimes, KnowTheLightOfFilesThatAreGone) {
    OpeningTimes times;
    times.note(file_of("known.glb", 100), 7.0, 5.0);
    EXPECT_DOUBLE_EQ(times.expected("/nowhere/at all.glb").value(), 5.0);
}

}  // namespace
}  // namespace raybundle
