// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "report/zip_file.h"

namespace raybundle {
namespace {

TEST(Zip, ComesBackWhole) {
    const ZipEntries entries = {
        {"a.txt", "hello"}, {"b/c.bin", std::string(100'000, 'x')}, {"d", ""}};
    const std::string bytes = write_zip(entries);
    EXPECT_LT(bytes.size(), 2000U);
    std::string reason;
    const auto back = read_zip(bytes, {}, reason);
    ASSERT_TRUE(back) << reason;
    EXPECT_EQ(*back, entries);
}

TEST(Zip, NeverReadsBeyondItsEnd) {
    const std::string bytes = write_zip({{"a.txt", "hello"}, {"b/c.bin", "some more text"}});
    std::string reason;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_FALSE(read_zip(bytes.substr(0, size), {}, reason));
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        for (const char to : {'\0', '\x7f', '\xff'}) {
            std::string damaged = bytes;
            damaged[at] = to;
            read_zip(damaged, {}, reason);  // refused or read, but nothing else
        }
    }
}

TEST(Zip, HasLimits) {
    std::string reason;
    const std::string large = write_zip({{"a", std::string(1'000'000, 'a')}});
    EXPECT_FALSE(read_zip(large, {10, 999'999}, reason));
    EXPECT_EQ(reason, "it is too large");
    EXPECT_FALSE(read_zip(write_zip({{"../a", "x"}}), {}, reason));
    EXPECT_FALSE(read_zip(write_zip({{"/a", "x"}}), {}, reason));
    EXPECT_FALSE(read_zip(write_zip({{"a", "x"}, {"b", "x"}}), {1, 100}, reason));
}

}  // namespace
}  // namespace raybundle
