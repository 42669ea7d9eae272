// SPDX-License-Identifier: Apache-2.0
#include "session/changes/special_settings.h"

#include <gtest/gtest.h>

namespace raybundle {
namespace {

void note_phase(PhaseBudget& budget, double milliseconds, unsigned bundles) {
    constexpr double begin_ms = 1000.0;
    budget.begin(begin_ms);
    for (unsigned i = 1; i <= bundles; ++i) {
        budget.note_bundle(begin_ms + i * milliseconds / bundles, i == bundles);
    }
}

PhaseBudget with_bundles_of(double milliseconds) {
    PhaseBudget budget;
    note_phase(budget, 8.0 * milliseconds, 8);
    return budget;
}

TEST(SpecialSettingsTest, IsTheUsualOneAsLongAsNothingIsKnown) {
    const SpecialSettings settings = special_settings(PhaseBudget(), 0.0, false);
    const SpecialSettings usual = interactive_special();
    EXPECT_EQ(settings.bundles, usual.bundles);
    EXPECT_EQ(settings.most_bundles, usual.bundles);
    EXPECT_EQ(settings.bounces, 0U);
}

TEST(SpecialSettingsTest, UsesAFastDevice) {
    const SpecialSettings settings = special_settings(with_bundles_of(1.0), 0.0, false);
    EXPECT_EQ(settings.bundles, 8U) << "the noise decides how many more";
    EXPECT_EQ(settings.most_bundles, max_special_bundles);
    EXPECT_GT(settings.bounces, 0U);
}

TEST(SpecialSettingsTest, KeepsTheDeadlineOfAMediumOne) {
    for (const double each : {2.0, 3.0, 4.0, 6.0}) {
        const SpecialSettings settings = special_settings(with_bundles_of(each), 0.0, false);
        EXPECT_LE(each * (settings.most_bundles + settings.bounces),
                  ChangeSettings().phase_deadline_ms);
        EXPECT_GT(settings.most_bundles, 8U) << each;
    }
}

TEST(SpecialSettingsTest, IsNeverLessThanTheUsualOne) {
    const SpecialSettings settings = special_settings(with_bundles_of(30.0), 0.0, false);
    EXPECT_EQ(settings.bundles, interactive_special().bundles);
    EXPECT_EQ(settings.most_bundles, settings.bundles);
    EXPECT_EQ(settings.bounces, 0U);
}

TEST(SpecialSettingsTest, SparesWhatTheNextChangeCorrects) {
    const SpecialSettings settings = special_settings(with_bundles_of(1.0), 0.0, true);
    EXPECT_EQ(settings.bundles, settings.most_bundles);
    EXPECT_EQ(settings.bounces, 0U);
}

TEST(SpecialSettingsTest, IsMoreCarefulForATarget) {
    const PhaseBudget budget = with_bundles_of(1.0);
    const float usual = special_settings(budget, 0.0, false).relevant_noise;
    EXPECT_EQ(special_settings(budget, 0.05, false).relevant_noise, usual);
    EXPECT_LT(special_settings(budget, 0.01, false).relevant_noise, usual);
    EXPECT_GT(special_settings(budget, 1e-6, false).relevant_noise, 0.0F);
}

TEST(SpecialSettingsTest, FollowsWhatPhasesTake) {
    PhaseBudget budget = with_bundles_of(30.0);
    for (int i = 0; i < 20; ++i) {
        note_phase(budget, 8.0, 8);
    }
    EXPECT_GT(special_settings(budget, 0.0, false).most_bundles, 8U);
}

TEST(SpecialSettingsTest, LearnsNothingFromAPhaseThatIsCutOff) {
    PhaseBudget budget = with_bundles_of(1.0);
    const unsigned before = special_settings(budget, 0.0, false).most_bundles;
    budget.begin(0.0);
    budget.note_bundle(1e6, false);
    EXPECT_EQ(special_settings(budget, 0.0, false).most_bundles, before);
    note_phase(budget, 8.0, 8);
    EXPECT_EQ(special_settings(budget, 0.0, false).most_bundles, before);
}

}  // namespace
}  // namespace raybundle
