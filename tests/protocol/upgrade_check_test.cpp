// SPDX-License-Identifier: Apache-2.0
#include "net/upgrade_check.h"

#include <gtest/gtest.h>

#include <vector>

namespace raybundle {
namespace {

TEST(UpgradeCheck, OnlyOnePath) {
    EXPECT_EQ(refusal_status({"/ws", "", "a:1"}, {}), 0);
    EXPECT_EQ(refusal_status({"/", "", "a:1"}, {}), 404);
    EXPECT_EQ(refusal_status({"/ws/", "", "a:1"}, {}), 404);
}

TEST(UpgradeCheck, PagesOfOtherOriginsAreRefused) {
    EXPECT_EQ(refusal_status({"/ws", "http://a:8080", "A:8080"}, {}), 0);
    EXPECT_EQ(refusal_status({"/ws", "https://a", "a"}, {}), 0);
    for (const char* origin : {"http://a:8081", "http://b:8080", "null", "http://", "a:8080",
                               "ftp://a:8080", "http://a:8080.evil"}) {
        EXPECT_EQ(refusal_status({"/ws", origin, "a:8080"}, {}), 403) << origin;
    }
    EXPECT_EQ(refusal_status({"/ws", "http://", ""}, {}), 403);
}

TEST(UpgradeCheck, AllowedOriginsAreAccepted) {
    const std::vector<std::string> allowed{"https://review.example"};
    EXPECT_EQ(refusal_status({"/ws", "https://Review.example", "a:8080"}, allowed), 0);
    EXPECT_EQ(refusal_status({"/ws", "http://review.example", "a:8080"}, allowed), 403);
}

}  // namespace
}  // namespace raybundle
