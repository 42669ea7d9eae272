// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "transport/scene_change.h"

namespace raybundle {

/// How many bundles a special phase (ch. 7.4) gets where somebody waits for the first frame after a
/// change: as many as there is time for until its deadline, by what earlier phases took, of which
/// the phase itself uses the more the more there is to correct. Never fewer than usual: of half as
/// many streaks remain, where light was taken away, for seconds. Has no clock of its own.
class PhaseBudget {
  public:
    /// Of the 150 ms from a change to its frame what is left beside composing and encoding it.
    static constexpr double deadline_ms = 110.0;
    /// More have no numbers of their own in the phase's sequences.
    static constexpr unsigned max_bundles = 64;

    /// A phase begins; its predecessor, where that is not at its end, does not count.
    void begin(double now_ms);
    /// A bundle of it, of either stage, has been transferred. last: the phase is at its end; what
    /// it took, waiting included, is what the next one is expected to take.
    void note_bundle(double now_ms, bool last);
    /// Since the running phase, or the last one, began.
    [[nodiscard]] double elapsed_ms(double now_ms) const { return now_ms - since_ms_; }

    /// target: smallest relative error that a viewer asks for, 0 where none does. hurried: the next
    /// change waits already, as in a drag, so that what this one leaves is soon corrected anyway.
    [[nodiscard]] SpecialSettings settings(double target, bool hurried) const;

  private:
    double bundle_ms_ = 0.0;  // 0: not known
    double since_ms_ = 0.0;   // of the running phase
    unsigned bundles_ = 0;    // likewise
};

}  // namespace raybundle
