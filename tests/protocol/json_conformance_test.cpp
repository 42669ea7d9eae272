// SPDX-License-Identifier: Apache-2.0
// JSONTestSuite (N. Seriot, "Parsing JSON is a Minefield"): y_ must be read, n_ must be refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "net/ws/json_scan.h"
#include "net/ws/wire_codec.h"

namespace raybundle {
namespace {

const std::filesystem::path kSuite =
    std::filesystem::path(RAYBUNDLE_SHARED_DATA) / "json/JSONTestSuite/test_parsing";

std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(JsonConformance, ReadsAndRefusesAsTheTestSuiteSays) {
    if (!std::filesystem::exists(kSuite)) {
        GTEST_SKIP() << kSuite << " is absent";
    }
    for (const auto& entry : std::filesystem::directory_iterator(kSuite)) {
        const std::string name = entry.path().filename();
        const std::string text = contents(entry.path());
        // Our messages are objects, so any other value is wrapped into one.
        const JsonScan scan = scan_json("{\"a\":" + text + "}", 1000);
        if (name.rfind("y_", 0) == 0) {
            EXPECT_EQ(scan.error, "") << name;
        } else if (name.rfind("n_", 0) == 0) {
            EXPECT_NE(scan.error, "") << name;
        }
        parse_text_message(text);  // must not crash, whatever it is
        parse_binary_message(text);
    }
}

}  // namespace
}  // namespace raybundle
