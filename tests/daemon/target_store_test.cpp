// SPDX-License-Identifier: Apache-2.0
// Targets by viewers' names, by themselves, with and without a journal.
#include "session/viewers/target_store.h"

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

class TargetStoreTest : public testing::Test {
  protected:
    [[nodiscard]] ChangeLog log() const {
        return ChangeLog({folder_.path("session.db"), "scene", "digest"});
    }

    TestFolder folder_;
};

TEST_F(TargetStoreTest, IsThereAgainAfterARestart) {
    {
        ChangeLog before = log();
        TargetStore store(before);
        EXPECT_TRUE(store.keep("wall", within(0.02F)));
        EXPECT_TRUE(store.keep("desk", within(0.05F)));
        EXPECT_TRUE(store.keep("wall", within(0.01F)));
        EXPECT_TRUE(store.keep("desk", {})) << "takes it back";
    }
    ChangeLog after = log();
    const TargetStore store(after);
    ASSERT_NE(store.of("wall"), nullptr);
    EXPECT_EQ(store.of("wall")->relative_error(), 0.01F);
    EXPECT_EQ(store.of("desk"), nullptr);
    EXPECT_EQ(store.of("nobody"), nullptr);
}

TEST_F(TargetStoreTest, ForgetsTheOldestWhereThereAreTooMany) {
    ChangeLog none;
    TargetStore store(none);
    for (std::size_t i = 0; i <= TargetStore::max_targets; ++i) {
        EXPECT_TRUE(store.keep("viewer " + std::to_string(i), within(0.1F)));
    }
    EXPECT_EQ(store.of("viewer 0"), nullptr);
    EXPECT_NE(store.of("viewer 1"), nullptr);
    EXPECT_NE(store.of("viewer " + std::to_string(TargetStore::max_targets)), nullptr);
}

TEST_F(TargetStoreTest, ViewersWithoutANameAreNotRemembered) {
    ChangeLog none;
    TargetStore store(none);
    EXPECT_TRUE(store.keep("", within(0.1F)));
    EXPECT_EQ(store.of(""), nullptr);
}

TEST_F(TargetStoreTest, WhatCannotBeStoredIsNotKept) {
    ChangeLog broken({folder_.path("no/such/folder/session.db"), "scene", "digest"});
    TargetStore store(broken);
    EXPECT_FALSE(store.keep("wall", within(0.1F)));
    EXPECT_EQ(store.of("wall"), nullptr);
}

}  // namespace
}  // namespace raybundle
