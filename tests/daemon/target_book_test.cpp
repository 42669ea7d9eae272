// SPDX-License-Identifier: Apache-2.0
// Targets by viewers' names, by themselves, with and without a journal.
#include "session/viewers/target_book.h"

#include <gtest/gtest.h>

#include <string>

#include "test_folder.h"

namespace raybundle {
namespace {

v1::SetTarget within(float error) {
    v1::SetTarget target;
    target.set_relative_error(error);
    return target;
}

class TargetBookTest : public testing::Test {
  protected:
    [[nodiscard]] ChangeLog log() const {
        return ChangeLog({folder_.path("session.db"), "scene", "digest"});
    }

    TestFolder folder_;
};

TEST_F(TargetBookTest, IsThereAgainAfterARestart) {
    {
        ChangeLog before = log();
        TargetBook book(before);
        EXPECT_TRUE(book.keep("wall", within(0.02F)));
        EXPECT_TRUE(book.keep("desk", within(0.05F)));
        EXPECT_TRUE(book.keep("wall", within(0.01F)));
        EXPECT_TRUE(book.keep("desk", {})) << "takes it back";
    }
    ChangeLog after = log();
    const TargetBook book(after);
    ASSERT_NE(book.of("wall"), nullptr);
    EXPECT_EQ(book.of("wall")->relative_error(), 0.01F);
    EXPECT_EQ(book.of("desk"), nullptr);
    EXPECT_EQ(book.of("nobody"), nullptr);
}

TEST_F(TargetBookTest, ForgetsTheOldestWhereThereAreTooMany) {
    ChangeLog none;
    TargetBook book(none);
    for (std::size_t i = 0; i <= TargetBook::max_targets; ++i) {
        EXPECT_TRUE(book.keep("viewer " + std::to_string(i), within(0.1F)));
    }
    EXPECT_EQ(book.of("viewer 0"), nullptr);
    EXPECT_NE(book.of("viewer 1"), nullptr);
    EXPECT_NE(book.of("viewer " + std::to_string(TargetBook::max_targets)), nullptr);
}

TEST_F(TargetBookTest, ViewersWithoutANameAreNotRemembered) {
    ChangeLog none;
    TargetBook book(none);
    EXPECT_TRUE(book.keep("", within(0.1F)));
    EXPECT_EQ(book.of(""), nullptr);
}

TEST_F(TargetBookTest, WhatCannotBeStoredIsNotKept) {
    ChangeLog broken({folder_.path("no/such/folder/session.db"), "scene", "digest"});
    TargetBook book(broken);
    EXPECT_FALSE(book.keep("wall", within(0.1F)));
    EXPECT_EQ(book.of("wall"), nullptr);
}

}  // namespace
}  // namespace raybundle
