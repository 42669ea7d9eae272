// SPDX-License-Identifier: Apache-2.0
#include "scheduling/cost_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raybundle {
namespace {

constexpr double kPicture = 800.0 * 600.0;

/// Iterations that cost 10 ms and 30 ms a megapixel, frames 50 ms a megapixel.
CostModel learnt() {
    CostModel model;
    for (int i = 0; i < 1000; ++i) {
        const double pixels = kPicture * (i / 100 % 5);
        model.note_iteration(10.0 + 30e-6 * pixels, pixels);
        model.note_frame(50e-6 * kPicture, kPicture);
    }
    return model;
}

TEST(CostModel, LearnsWhatViewersCost) {
    const CostModel model = learnt();
    EXPECT_NEAR(model.round_ms(0.0), 10.0, 1.0);
    EXPECT_NEAR(model.round_ms(10 * kPicture), 10.0 + 80e-6 * 10 * kPicture, 8.0);
}

TEST(CostModel, AssumesSomethingBeforeItKnows) {
    const CostModel model;
    EXPECT_NEAR(model.round_ms(640000.0), 40.0, 5.0);
}

TEST(CostModel, WithOneSizeOnlyTheSlopeStaysInBounds) {
    CostModel model;
    for (int i = 0; i < 1000; ++i) {
        model.note_iteration(2.0, kPicture);
    }
    const double slope = model.round_ms(1e6) - model.round_ms(0.0);
    EXPECT_GT(slope, 0.0);
    EXPECT_LE(slope, 2.0 / kPicture * 1e6 + 44.1);
    EXPECT_GE(model.round_ms(0.0), 0.0);
}

TEST(CostModel, AdmitsUntilTheRoundIsFullAndSaysWhatWouldFit) {
    const CostModel model = learnt();
    constexpr double kLimitMs = 1000.0;
    double present = 0.0;
    int viewers = 0;
    while (model.admit(800, 600, present, kLimitMs).fits && viewers < 1000) {
        present += kPicture;
        ++viewers;
    }
    // (1000 - 10) ms / (80e-6 ms * 480 000) = 25.8
    EXPECT_GE(viewers, 24);
    EXPECT_LE(viewers, 27);
    const auto refused = model.admit(3840, 2160, 20 * kPicture, kLimitMs);
    EXPECT_FALSE(refused.fits);
    ASSERT_TRUE(refused.would_fit.has_value());
    const auto [width, height] = *refused.would_fit;
    EXPECT_TRUE(model.admit(width, height, 20 * kPicture, kLimitMs).fits);
    EXPECT_FALSE(model.admit(width + 40, height + 40, 20 * kPicture, kLimitMs).fits);
    EXPECT_NEAR(static_cast<double>(width) / height, 16.0 / 9.0, 0.01);
}

TEST(CostModel, NothingFitsWhereItIsFullButTheFirstViewerAlwaysDoes) {
    const CostModel model = learnt();
    EXPECT_FALSE(model.admit(64, 64, 100 * kPicture, 1000.0).would_fit.has_value());
    EXPECT_TRUE(model.admit(3840, 2160, 0.0, 1.0).fits);
}

/// What a frame of one pixel costs says nothing about large ones: else whoever asks for such frames
/// shuts out everybody.
TEST(CostModel, TinyPicturesDoNotShutOutLargeOnes) {
    CostModel model;
    for (int i = 0; i < 1000; ++i) {
        model.note_iteration(10.0, 1.0);
        model.note_frame(2.0, 1.0);
    }
    EXPECT_TRUE(model.admit(1280, 720, 1.0, 1000.0).fits);
    for (int i = 0; i < 100; ++i) {
        model.note_frame(500e-6 * kPicture, kPicture);
    }
    EXPECT_NEAR(model.round_ms(1e6) - model.round_ms(0.0), 520.0, 30.0) << "a slow machine";
}

TEST(CostModel, NonsenseIsIgnored) {
    CostModel model = learnt();
    const double before = model.round_ms(kPicture);
    model.note_iteration(std::nan(""), kPicture);
    model.note_iteration(-1.0, kPicture);
    model.note_frame(1.0, 0.0);
    EXPECT_EQ(model.round_ms(kPicture), before);
}

}  // namespace
}  // namespace raybundle
