// SPDX-License-Identifier: Apache-2.0
// Whose picture there is memory for.
#include "session/memory_room.h"

#include <gtest/gtest.h>

#include <sstream>

namespace raybundle {
namespace {

TEST(MemoryRoom, IsReadAsLinuxTellsIt) {
    std::istringstream text(
        "MemTotal:  100 kB\nMemFree: 10 kB\nMemAvailable:     42 kB\nBuffers: 1 kB\n");
    EXPECT_EQ(memory_available_in(text), 42.0 * 1024.0);
    std::istringstream old("MemTotal:  100 kB\n");
    EXPECT_FALSE(memory_available_in(old));
    EXPECT_GT(available_memory().value_or(1.0), 0.0);
}

TEST(MemoryRoom, MakesPicturesSmallerBeforeItRefusesThem) {
    const glm::uvec2 wanted(1600, 900);
    EXPECT_EQ(size_within_memory(wanted, 100.0, 1600.0 * 900.0 * 100.0), wanted);
    EXPECT_EQ(size_within_memory(wanted, 100.0, 1600.0 * 900.0 * 25.0), glm::uvec2(800, 450));
    EXPECT_FALSE(size_within_memory(wanted, 100.0, 64.0 * 63.0 * 100.0));
    EXPECT_FALSE(size_within_memory(wanted, 100.0, 0.0));
}

}  // namespace
}  // namespace raybundle
