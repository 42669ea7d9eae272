// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "gpu/readback.h"
#include "journal/solution_exchange.h"
#include "scheduling/clock.h"
#include "session/live_scene.h"

namespace raybundle {

/// Gives other workers of the project what own iterations have brought since the last change, and
/// has the solution merge what theirs have. Copies between GPU and memory are made outside of
/// iterations, and take a twentieth of the time at most. Does nothing without an exchange.
class SolutionSharing {
  public:
    struct Parts {
        LiveScene& scene;
        const Clock& clock;
        SolutionExchange* exchange;  ///< null: there is none
        /// Of all that workers must have in common beside the mesh.
        std::uint64_t fingerprint = 0;
    };
    explicit SolutionSharing(const Parts& parts) : parts_(parts) {}

    void step();
    [[nodiscard]] std::optional<ExchangeFigures> figures() const;

  private:
    /// What the solution is of.
    struct Subject {
        const Solver* solver = nullptr;
        std::uint64_t fade_steps = 0;
        SolutionState state;
        bool operator==(const Subject&) const = default;
    };

    void follow_scene();
    void take_own();
    void ask_for_own();
    void merge();

    Parts parts_;
    Subject subject_;
    std::optional<Readback> readback_;  ///< of own means
    std::uint64_t asked_samples_ = 0;   ///< when own means were asked for last
    double own_weight_ = 0.0;           ///< of what was published last
    TimePoint next_;                    ///< nothing before
};

}  // namespace raybundle
