// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "journal/change_sum.h"

namespace raybundle {

/// What the objects, lights and materials were like after each of the last changes, for undo.
class SceneHistory {
  public:
    static constexpr std::size_t max_changes = 16384;

    /// first: epoch of the state that nothing is known before.
    explicit SceneHistory(std::uint32_t first = 0) : oldest_(first), newest_(first) {}

    /// A change with its epoch has been made. Both states name everything that the subject has.
    /// run: AnimationStep::first_epoch of what an animation changes, else 0. Of one that plays on
    /// and on only the last state counts, as far as nobody else has changed anything meanwhile.
    void note(const v1::SceneChanged& before, const v1::SceneChanged& after, std::uint32_t run = 0);

    /// Earliest epoch that can be gone back to.
    [[nodiscard]] std::uint32_t oldest() const { return oldest_; }
    [[nodiscard]] std::uint32_t newest() const { return newest_; }
    /// What brings the present scene to the state of an epoch from oldest() to newest(); nothing
    /// for other epochs.
    [[nodiscard]] std::optional<std::vector<v1::SceneChanged>> back_to(std::uint32_t epoch) const;

  private:
    void forget_oldest();

    std::uint32_t oldest_, newest_;
    std::size_t changes_ = 0;
    std::uint32_t run_ = 0;        ///< of the last change
    std::uint32_t run_since_ = 0;  ///< first of the changes in a row that are of it
    /// Of each subject the states in order of epochs, the first one that before any change.
    std::map<ChangeSubject, std::vector<v1::SceneChanged>> states_;
};

}  // namespace raybundle
