// SPDX-License-Identifier: Apache-2.0
// The board of pins and viewpoints by itself, without a server.
#include "session/review/review_board.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace raybundle {
namespace {

Pin pin(const std::string& text, std::uint32_t epoch = 0) {
    Pin result;
    result.message.set_text(text);
    result.message.set_epoch(epoch);
    result.patch_illuminance = 200.0F;
    return result;
}

TEST(ReviewBoard, NumbersPinsAndNeverGivesANumberTwice) {
    ChangeLog log;
    ReviewBoard board(log);
    EXPECT_EQ(board.add_pin(pin("a"))->message.pin(), 1U);
    EXPECT_EQ(board.add_pin(pin("b"))->message.pin(), 2U);
    EXPECT_TRUE(board.remove_pin(2));
    EXPECT_EQ(board.add_pin(pin("c"))->message.pin(), 3U);
    EXPECT_FALSE(board.remove_pin(2));
    EXPECT_EQ(board.refusal().code(), v1::Error::NOT_FOUND);
}

TEST(ReviewBoard, IsBounded) {
    ChangeLog log;
    ReviewBoard board(log);
    for (std::size_t i = 0; i < ReviewBoard::max_pins; ++i) {
        ASSERT_NE(board.add_pin(pin("x")), nullptr);
    }
    EXPECT_EQ(board.add_pin(pin("one too many")), nullptr);
    EXPECT_EQ(board.refusal().code(), v1::Error::RESOURCE_EXHAUSTED);
    for (std::size_t i = 0; i < ReviewBoard::max_viewpoints; ++i) {
        ASSERT_NE(board.add_viewpoint({}), nullptr);
    }
    EXPECT_EQ(board.add_viewpoint({}), nullptr);
}

TEST(ReviewBoard, LooksAtEveryPinInTurn) {
    ChangeLog log;
    ReviewBoard board(log);
    EXPECT_EQ(board.next_pin(), nullptr);
    board.add_pin(pin("a"));
    board.add_pin(pin("b"));
    EXPECT_EQ(board.next_pin()->message.text(), "a");
    EXPECT_EQ(board.next_pin()->message.text(), "b");
    EXPECT_EQ(board.next_pin()->message.text(), "a");
}

TEST(ReviewBoard, TellsNewcomersEverything) {
    ChangeLog log;
    ReviewBoard board(log);
    board.add_pin(pin("a"));
    v1::Welcome welcome;
    board.fill_welcome(&welcome);
    ASSERT_EQ(welcome.pins_size(), 1);
    EXPECT_EQ(welcome.pins(0).text(), "a");
}

TEST(LightAtAPin, IsComparedOnlyWithWhatItWasBeforeTheChange) {
    Pin p = pin("a", 4);
    EXPECT_FALSE(update_change(p, 210.0F, 4));  // the solution refines: that is the value then
    EXPECT_FALSE(p.message.has_change());
    EXPECT_TRUE(update_change(p, 105.0F, 5));
    EXPECT_NEAR(p.message.change(), -0.5F, 1e-6F);
    EXPECT_FALSE(update_change(p, 106.0F, 5));  // not worth telling
    EXPECT_TRUE(update_change(p, 210.0F, 6));
    EXPECT_NEAR(p.message.change(), 0.0F, 1e-6F);
}

TEST(LightAtAPin, ThatWasDarkHasNoInfiniteChange) {
    Pin p = pin("a", 0);
    p.patch_illuminance = 0.0F;
    EXPECT_TRUE(update_change(p, 50.0F, 1));
    EXPECT_TRUE(std::isfinite(p.message.change()));
}

}  // namespace
}  // namespace raybundle
