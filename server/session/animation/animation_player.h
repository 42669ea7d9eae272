// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "journal/change_sum.h"
#include "scene/animation/scene_animations.h"
#include "scheduling/clock.h"

namespace raybundle {

/// Says where the animations of a scene are at a time, and which changes bring the scene there.
/// Makes none itself, and knows nobody who watches.
class AnimationPlayer {
  public:
    AnimationPlayer(const Scene& scene, const Clock& clock);

    /// Takes up where animations stood, the oldest step first.
    void restore(const std::vector<v1::AnimationStep>& steps);

    /// Why a request cannot be met; an unset code where it can.
    [[nodiscard]] v1::Error problem_of(const v1::PlayAnimation& request) const;

    /// Of the animation that a request without problem names.
    [[nodiscard]] std::size_t index_of(const v1::PlayAnimation& request) const;

    /// Meets a request without problem of a viewer. Returns the animations whose state has changed:
    /// the one that is asked for, and those that it pauses, since they move the same.
    std::vector<std::size_t> play(const v1::PlayAnimation& request, std::uint32_t by,
                                  const std::string& by_name);

    /// Somebody changes something by hand: pauses and returns the animations that were changing
    /// it.
    std::vector<std::size_t> make_way(const v1::SceneChanged& change);

    /// Pauses all where they are, as before an undo; returns those that played.
    std::vector<std::size_t> stop_all();
    /// An undo has brought the scene back to an epoch.
    void note_undo(std::uint32_t epoch);

    /// The changes that bring the scene to where one of the animations is by now, that waits
    /// longest: to the last place of one that does not play any more, else only while `watched`.
    /// Empty: all are there.
    std::vector<v1::SceneChanged> step(bool watched);
    /// Whether any of them plays.
    [[nodiscard]] bool playing() const;
    /// Animations that have come to their end since the last call.
    std::vector<std::size_t> take_ended() { return std::exchange(ended_, {}); }

    /// A change of step() gets this number: notes in it to which run it belongs.
    void number(v1::SceneChanged& change, std::uint32_t epoch) const;
    /// It is in the log under that number.
    void note_recorded(const v1::SceneChanged& change, std::uint32_t epoch);

    /// All of the state of an animation.
    [[nodiscard]] v1::PlayAnimation state_of(std::size_t animation) const;
    /// What the scene says of its animations.
    void describe(v1::Scene* message) const;

  private:
    struct State {
        bool playing = false;
        bool loop = false;
        double speed = 1.0;
        double seconds = 0.0;  ///< at `since`
        TimePoint since;
        bool due = false;    ///< to be brought to its last place
        double shown = 0.0;  ///< where the last step has brought it
        std::uint32_t by = 0;
        std::string by_name;
        TimePoint touched;              ///< by this viewer
        std::uint32_t first_epoch = 0;  ///< of its run; 0: none of its changes has been made yet
        std::set<std::uint32_t> moved;  ///< objects that the run has moved
        std::set<ChangeSubject> left;   ///< to who changes them by hand
        /// Where it stood after an epoch, at the ends of runs, in order.
        std::deque<std::pair<std::uint32_t, double>> stands;
    };

    [[nodiscard]] const Animation& animation(std::size_t index) const;
    [[nodiscard]] double place_of(std::size_t index, bool& ended) const;
    void settle(std::size_t index);
    void begin_run(std::size_t index, std::uint32_t by, const std::string& by_name);
    [[nodiscard]] std::vector<AnimationPlace> places(std::size_t last, double seconds) const;
    std::vector<v1::SceneChanged> step_of(std::size_t index);
    void touch(std::size_t index);
    void stop(std::size_t index);

    const Scene& scene_;
    const Clock& clock_;
    std::vector<State> states_;
    std::vector<std::size_t> touched_;  // those that have ever moved anything, the last one last
    std::vector<std::size_t> ended_;
    std::size_t next_ = 0;  // whose turn it is
};

}  // namespace raybundle
