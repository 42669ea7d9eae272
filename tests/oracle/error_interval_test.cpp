// SPDX-License-Identifier: Apache-2.0
// Error bars: their arithmetic, and a hundred pictures against their true errors. 800, more scenes
// and targets: error_interval_statistics_test.cpp.
#include "view/error/error_interval.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "judged_scene.h"
#include "view/error/measured_error.h"

namespace raybundle::error_interval_test {
namespace {

constexpr std::array<SampleOrder, 2> both = {SampleOrder::low_discrepancy, SampleOrder::shuffled};

TEST(ErrorIntervalOf, HasTheErrorBetweenItsEnds) {
    for (const auto& [noise, rest] :
         {std::pair(0.1, 0.0), std::pair(0.0, 0.1), std::pair(0.3, 0.1), std::pair(0.01, 0.1)}) {
        const ErrorInterval interval =
            error_interval(noise, rest, 64, SampleOrder::low_discrepancy);
        EXPECT_DOUBLE_EQ(interval.error, std::hypot(noise, rest));
        EXPECT_LT(interval.low, interval.error);
        EXPECT_GT(interval.high, interval.error);
    }
    EXPECT_EQ(error_interval(0.0, 0.0, 64, SampleOrder::low_discrepancy).high, 0.0);
}

/// Two parts that err independently are known better together than either alone.
TEST(ErrorIntervalOf, IsNarrowestWhereBothPartsAreEqual) {
    for (const SampleOrder order : both) {
        const auto width = [&](double noise, double rest) {
            const ErrorInterval interval = error_interval(noise, rest, 256, order);
            return interval.high / interval.error;
        };
        EXPECT_LT(width(0.1, 0.1), width(0.1, 0.0));
        EXPECT_LT(width(0.1, 0.1), width(0.0, 0.1));
    }
}

/// More noise never ends lower, so that a target that is met stays met with more samples.
TEST(ErrorIntervalOf, EndsHigherWithMoreNoise) {
    for (const SampleOrder order : both) {
        double last = 0.0;
        for (int step = 0; step < 300; ++step) {
            const double noise = 0.001 * step;
            const double high = error_interval(noise, 0.05, 1024, order).high;
            EXPECT_GT(high, last) << noise;
            last = high;
        }
    }
}

TEST(VarianceOfMean, BeginsAsOfIndependentSamplesAndFallsWithTheSequence) {
    for (const SampleOrder order : both) {
        EXPECT_DOUBLE_EQ(variance_of_mean(0, order), 1.0);
        EXPECT_DOUBLE_EQ(variance_of_mean(2, order), 1.0);
        EXPECT_GT(variance_of_mean(64, order), variance_of_mean(128, order));
    }
    EXPECT_LT(variance_of_mean(512, SampleOrder::low_discrepancy),
              variance_of_mean(512, SampleOrder::shuffled));
}

/// So many times more samples bring the noise, which falls with their power, to where the interval
/// ends at the target.
/// By chance the iterate is a few times the noise ahead, the more samples the more.
TEST(LagOfMean, IsNothingByChanceAndNearlyAllThatIsFarBeyond) {
    for (const SampleOrder order : {SampleOrder::low_discrepancy, SampleOrder::shuffled}) {
        for (const bool sky : {false, true}) {
            EXPECT_EQ(lag_of_mean(0.0, 0.0, 0, order, sky), 0.0);
            EXPECT_EQ(lag_of_mean(0.01, 0.01, 1000, order, sky), 0.0);
            EXPECT_EQ(lag_of_mean(-0.01, 0.01, 1000, order, sky), 0.0);
            EXPECT_NEAR(lag_of_mean(0.4, 0.01, 1000, order, sky), 0.4, 0.02);
            EXPECT_NEAR(lag_of_mean(-0.4, 0.01, 1000, order, sky), 0.4, 0.02);
        }
    }
    EXPECT_EQ(lag_of_mean(0.09, 0.02, 1024, SampleOrder::low_discrepancy, false), 0.0);
    EXPECT_GT(lag_of_mean(0.11, 0.02, 1024, SampleOrder::low_discrepancy, false), 0.0);
}

/// A picture without changes, of noise alone.
TwoMeans only_noise() {
    TwoMeans means;
    means.noise = 0.2;
    means.ahead = 0.1;
    return means;
}

TEST(SuspectedError, IsNothingByChance) {
    for (const SampleOrder order : both) {
        for (const std::uint64_t samples : {0U, 8U, 16U, 200U, 5000U}) {
            TwoMeans means = only_noise();
            means.kept_share = 0.8;
            means.apart = 0.1;
            means.noise_apart = 0.1;
            const SuspectedError none = suspected(means, samples, order, false);
            EXPECT_EQ(none.missing, 0.0);
            EXPECT_EQ(none.left_over, 0.0);
        }
    }
}

/// Light that was kept over a change and contradicts what comes in is left over, or dimmer than
/// what is to come.
TEST(SuspectedError, IsTheDifferenceOfBothMeansBeyondChance) {
    TwoMeans means = only_noise();
    means.noise = 0.1;
    means.kept_share = 0.9;
    means.noise_apart = 0.05;
    means.apart = 0.8;
    const auto order = SampleOrder::low_discrepancy;
    const SuspectedError falls = suspected(means, 64, order, false);
    EXPECT_NEAR(falls.left_over, 0.8, 0.05);
    EXPECT_EQ(falls.missing, 0.0);
    means.rises = true;
    means.apart = 4.0;
    const SuspectedError rises = suspected(means, 64, order, false);
    EXPECT_NEAR(rises.missing, 0.8, 0.02);  // of the brighter light
    EXPECT_EQ(rises.left_over, 0.0);
}

/// Much brighter light than what is there now leaves some of itself.
TEST(SuspectedError, KnowsWhatALampLeavesBehind) {
    TwoMeans means = only_noise();
    means.changed = 30.0;
    const auto order = SampleOrder::low_discrepancy;
    EXPECT_NEAR(suspected(means, 100, order, false).left_over, 0.15, 1e-6);
    const SuspectedError soon = suspected(means, 16, order, false);
    EXPECT_LT(soon.left_over, 1.0);
    const ErrorInterval said = error_interval(0.1, 0.0, 16, order);
    const ErrorInterval wide = with_left_over(said, soon.left_over);
    EXPECT_GT(wide.high, 5.0);
    EXPECT_GT(wide.error, 0.5);
    EXPECT_EQ(wide.low, said.low);
    EXPECT_EQ(with_left_over(said, 0.0).high, said.high);
}

/// Light that has halved since there were half as many samples goes on falling; what rises, rises.
TEST(SuspectedError, ForeseesThatFallingLightFallsOn) {
    TwoMeans means = only_noise();
    means.shown_noise = 0.05;
    means.changed = 30.0;  // counts only while nothing better is known
    means.earlier = 1.3;
    means.more = 2.0;
    const auto order = SampleOrder::low_discrepancy;
    EXPECT_NEAR(suspected(means, 64, order, false).left_over, 0.27, 0.03);
    means.more = 4.0;  // a slower fall
    EXPECT_LT(suspected(means, 64, order, false).left_over, 0.12);
    means.earlier = 0.7;
    means.more = 2.0;
    const SuspectedError rises = suspected(means, 64, order, false);
    EXPECT_EQ(rises.left_over, 0.0);
    EXPECT_NEAR(rises.missing, 0.27, 0.03);
    means.earlier = 1.05;
    EXPECT_EQ(suspected(means, 64, order, false).left_over, 0.0);  // by chance
}

TEST(AfterChange, IsWiderWhileItIsNew) {
    const ErrorInterval said = error_interval(0.1, 0.02, 32, SampleOrder::low_discrepancy);
    const ErrorInterval soon = after_change(said, 32);
    EXPECT_GT(soon.high, said.high);
    EXPECT_LT(soon.low, said.low);
    EXPECT_NEAR(after_change(said, 1'000'000).high, said.high, 1e-4);
    EXPECT_GT(said.error / soon.low, soon.high / said.error) << "kept light is rather better";
}

/// More is missing the fewer samples matter, and never more than e^0.6.
TEST(FewSamples, RaiseWhatTheirScatterSays) {
    EXPECT_EQ(few_samples(0.0), 1.0);
    EXPECT_LT(few_samples(0.1), few_samples(0.5));
    EXPECT_NEAR(few_samples(0.5), std::exp(0.3), 1e-12);
    EXPECT_EQ(few_samples(7.0), few_samples(1.0));
}

/// Where chance has more to say the interval is wider.
TEST(ErrorIntervalOf, IsAsWideAsLuckAndFewSamplesMakeIt) {
    const auto order = SampleOrder::low_discrepancy;
    const auto width = [&](double noise, double luck) {
        const ErrorInterval interval = error_interval(noise, 0.0, 64, order, luck);
        return interval.high / interval.error;
    };
    EXPECT_LT(width(0.05, 0.3), width(0.05, 0.6));
    EXPECT_LT(width(0.05, 0.3), width(0.2, 0.3));
    EXPECT_DOUBLE_EQ(width(0.9, 0.3), width(0.95, 0.3));
}

ImageStatistics picture_of(double rms, double error_high) {
    ImageStatistics s;
    s.known = true;
    s.rms_luminance = rms;
    s.error_high = error_high;
    s.unresolved_light = 0.01;
    s.faint_light = 0.1;
    return s;
}

TEST(DarkerThan, IsSaidWhereLightMayAsWellBeNone) {
    EXPECT_FALSE(picture_of(0.05, 0.3).darker_than());  // known
    EXPECT_FALSE(picture_of(0.3, 5.0).darker_than());   // too much
    EXPECT_NEAR(picture_of(0.04, 5.0).darker_than().value_or(0.0), 0.08, 1e-9);
    EXPECT_NEAR(picture_of(0.001, 0.1).darker_than().value_or(0.0), 0.01, 1e-9);  // unresolved
    ImageStatistics black = picture_of(0.0, 0.0);
    black.unresolved_light = 0.0;
    EXPECT_TRUE(picture_of(0.0, 0.0).darker_than());
    EXPECT_NEAR(black.darker_than().value_or(0.0), 0.1, 1e-9);
    black.known = false;
    EXPECT_FALSE(black.darker_than());
}

TEST(SamplesFactor, LeadsToTheTarget) {
    constexpr double noise = 0.2;
    constexpr double rest = 0.005;
    constexpr double target = 0.02;
    for (const SampleOrder order : both) {
        const double factor = samples_factor(noise, rest, target, 1024, order);
        ASSERT_GT(factor, 1.0);
        const auto n = static_cast<std::uint64_t>(1024.0 * factor);
        // Of independent samples: 1/sqrt(n).
        const double then =
            noise * std::sqrt(variance_of_mean(n, order) / variance_of_mean(1024, order) / factor);
        EXPECT_NEAR(error_interval(then, rest, n, order).high, target, 1e-4);
        EXPECT_EQ(samples_factor(noise, rest, 1.0, 1024, order), 1.0);
        EXPECT_TRUE(std::isinf(samples_factor(noise, 0.02, target, 1024, order)));
    }
}

/// What agrees makes sure; what was measured well counts alone.
TEST(MeasuredInterval, IsNarrowerWhereBothAgreeAndFollowsWhatWasMeasuredElsewhere) {
    const ErrorInterval said{0.02, 0.014, 0.0286};
    const ErrorInterval together = measured_interval(said, 0.0004, 0.0001);
    EXPECT_NEAR(together.error, 0.02, 0.0005);
    EXPECT_LT(together.high - together.low, said.high - said.low);
    EXPECT_LT(together.high - together.low, 2.0 * (std::sqrt(0.0006) - 0.02) * 1.96);

    const ErrorInterval above = measured_interval(said, 0.01, 0.0005);
    EXPECT_NEAR(above.error, 0.1, 0.003);
    EXPECT_GT(above.low, 0.09);
    EXPECT_LT(above.high, 0.11);
    const ErrorInterval below = measured_interval(said, 1e-5, 1e-5);
    EXPECT_LT(below.error, 0.008);
}

/// Where nothing was measured, or so badly that it says nothing, the samples have the word.
TEST(MeasuredInterval, IsWhatSamplesSayWhereNothingWasMeasured) {
    const ErrorInterval said{0.02, 0.014, 0.0286};
    const ErrorInterval nothing =
        measured_interval(said, 0.0, std::numeric_limits<double>::infinity());
    EXPECT_EQ(nothing.error, said.error);
    EXPECT_EQ(nothing.high, said.high);
    const ErrorInterval hardly = measured_interval(said, -0.001, 0.05);
    EXPECT_NEAR(hardly.error, said.error, 0.001);
    EXPECT_GT(hardly.high, said.high);  // they may be far off
    const ErrorInterval black = measured_interval({0.0, 0.0, 0.0}, 0.01, 0.001);
    EXPECT_EQ(black.error, 0.0);
}

/// What was measured counts by the share that its samples have then, and the rest is as expected.
TEST(SamplesFactor, OfWhatWasMeasuredLeadsToTheTarget) {
    constexpr double target = 0.03;
    constexpr double width = 1.1;
    const ErrorInterval measured{0.05, 0.045, width * 0.05};
    for (const double noise : {0.03, 0.049, 0.07}) {
        const double factor =
            samples_factor({measured, noise, 0.01, 0.005}, target, SampleOrder::low_discrepancy);
        ASSERT_GT(factor, 1.0);
        const double mix = (1.0 - 1.0 / factor) * noise * noise + 0.0024 / factor;
        const double error = std::sqrt(mix * std::pow(factor, -1.5) + 0.005 * 0.005);
        EXPECT_NEAR(width * error, target, 1e-8);
    }
    EXPECT_EQ(samples_factor({measured, 0.05, 0.01, 0.01}, 0.07, SampleOrder::shuffled), 1.0);
    // Finer pixels bring within reach what was out of it.
    EXPECT_TRUE(
        std::isinf(samples_factor({measured, 0.04, 0.03, 0.03}, 0.03, SampleOrder::shuffled)));
    EXPECT_TRUE(
        std::isfinite(samples_factor({measured, 0.04, 0.03, 0.01}, 0.03, SampleOrder::shuffled)));
}

ImageStatistics statistics_of(std::uint64_t samples, double noise, double discretisation) {
    const ErrorInterval said =
        error_interval(noise, discretisation, samples, SampleOrder::low_discrepancy);
    ImageStatistics s;
    s.known = true;
    s.samples = samples;
    s.relative_error = said.error;
    s.error_low = said.low;
    s.error_high = said.high;
    s.noise = noise;
    s.discretisation = discretisation;
    return s;
}

/// Noise that is gone takes with it no more than the samples knew of.
TEST(MeasuredError, WhatSamplesDoNotKnowOfStaysAsTheyCome) {
    MeasuredError measured;
    const ImageStatistics before = statistics_of(100, 0.04, 0.0);
    measured.take({0.01, 0.0005}, before);  // 10 %
    ASSERT_TRUE(measured.known());
    EXPECT_NEAR(measured.with(before).relative_error, 0.1, 0.005);
    const ImageStatistics later = statistics_of(110, 0.02, 0.0);
    const ImageStatistics after = measured.with(later);
    EXPECT_NEAR(after.relative_error, std::sqrt(0.01 - 0.04 * 0.04 + 0.02 * 0.02), 0.01);
    EXPECT_GT(after.discretisation, 0.07);
    EXPECT_TRUE(std::isinf(measured.samples_factor_to(0.05, later, SampleOrder::low_discrepancy)));
}

/// Whatever the target, a run ends once its noise is gone: it is met, or it never will be.
TEST(MeasuredError, LeavesNoTargetOpenForEver) {
    for (int step = 0; step < 150; ++step) {
        const double target = 0.02 * std::pow(1.02, step);          // up to 40 %
        for (const double error : {0.05, 0.06, 0.08, 0.1, 0.15}) {  // samples call it 6 %
            MeasuredError measured;
            const ImageStatistics s = statistics_of(100000, 1e-4, 0.06);
            measured.take({error * error, 0.15 * error * error}, s);
            EXPECT_TRUE(measured.with(s).meets(target)) << target << " of " << error;
        }
    }
}

TEST(MeasuredError, IsNotTakenWhereItSaysLessThanTheSamples) {
    MeasuredError measured;
    const ImageStatistics s = statistics_of(100, 0.1, 0.0);
    measured.take({0.005, 0.02}, s);
    EXPECT_FALSE(measured.known());
    EXPECT_EQ(measured.with(s).error_high, s.error_high);
    measured.take({0.01, 0.001}, s);
    EXPECT_TRUE(measured.known());
}

TEST(MeasuredError, StaysWhenThePictureShowsSomethingElseUntilPathsSayOtherwise) {
    MeasuredError measured;
    measured.take({0.07, 0.005}, statistics_of(100, 0.01, 0.0));  // 26 %
    measured.carry_over();
    EXPECT_FALSE(measured.known());
    const ImageStatistics changed = statistics_of(40, 0.006, 0.0);
    for (int i = 0; i < 2; ++i) {  // another change before paths have come
        const ImageStatistics stated = measured.with(changed);
        EXPECT_NEAR(stated.relative_error, 0.26, 0.01);
        EXPECT_GE(stated.error_high, stated.relative_error);
        EXPECT_EQ(stated.error_low, changed.error_low);
        EXPECT_FALSE(stated.meets(0.05));
        EXPECT_TRUE(
            std::isinf(measured.samples_factor_to(0.05, changed, SampleOrder::low_discrepancy)));
        measured.carry_over();
    }
    measured.take({0.02, 0.2}, changed);  // says nothing
    EXPECT_NEAR(measured.with(changed).relative_error, 0.26, 0.01);
    measured.take({0.0, 0.002}, changed);
    EXPECT_LT(measured.with(changed).relative_error, 0.02);
    measured.carry_over();
    EXPECT_EQ(measured.with(changed).error_high, changed.error_high);
}

TEST(MeasuredError, CarriesNothingThatSamplesKnewOf) {
    MeasuredError measured;
    measured.take({0.009, 0.001}, statistics_of(100, 0.1, 0.0));
    measured.carry_over();
    const ImageStatistics changed = statistics_of(40, 0.006, 0.0);
    EXPECT_EQ(measured.with(changed).error_high, changed.error_high);
}

/// Pictures, four of each run. Their errors are 10 to 30 %, of which the noise of the reference (2
/// %) is a small part. least: so many of them all, and of those that viewers are told, are right.
void expect_coverage(std::uint64_t runs, std::size_t least, std::size_t least_viewers) {
    const JudgedScene scene("cornell_box.gltf", 0.4F, 512);
    EXPECT_LT(scene.reference_noise(), 0.03);
    Coverage measured;
    Coverage viewers;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        scene.run(seed, 0.02, [&](const JudgedPicture& picture) {
            measured.add(picture.error, picture.said);
            viewers.add(picture.viewer_error, picture.viewer_said);
            return picture.iterations < 64;
        });
    }
    testing::Test::RecordProperty("measured", measured.text());
    testing::Test::RecordProperty("viewers", viewers.text());
    std::printf("measured: %s\nviewers: %s\n", measured.text().c_str(), viewers.text().c_str());
    EXPECT_EQ(measured.pictures, 4 * runs);
    EXPECT_GE(measured.covered, least) << measured.text();
    EXPECT_LE(measured.half_width(), 0.3) << measured.text();
    EXPECT_GE(viewers.covered, least_viewers) << viewers.text();
    EXPECT_LE(viewers.half_width(), 0.5) << viewers.text();
}

/// With 95 % right, fewer than 44 of 52, or 87 of 100, are found right once in 1000 times if they
/// are independent; the four of a run are not quite.
TEST(ErrorInterval, CoversTheTrueErrorOfMostPictures) {
    expect_coverage(13, 44, 43);
}

TEST(ErrorIntervalHeavy, CoversTheTrueErrorOfMostPictures) {
    expect_coverage(25, 87, 85);
}

}  // namespace
}  // namespace raybundle::error_interval_test
