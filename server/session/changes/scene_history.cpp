// SPDX-License-Identifier: Apache-2.0
#include "session/changes/scene_history.h"

#include <google/protobuf/util/message_differencer.h>
#include <algorithm>

namespace raybundle {

namespace {

/// The last of the states that was there at an epoch; they begin with one that was.
const v1::SceneChanged& state_at(const std::vector<v1::SceneChanged>& states, std::uint32_t epoch) {
    const auto later =
        std::find_if(states.begin() + 1, states.end(),
                     [epoch](const v1::SceneChanged& state) { return state.epoch() > epoch; });
    return *std::prev(later);
}

bool same_state(v1::SceneChanged a, v1::SceneChanged b) {
    for (v1::SceneChanged* state : {&a, &b}) {
        state->clear_epoch();
        state->clear_by();
    }
    return google::protobuf::util::MessageDifferencer::Equals(a, b);
}

}  // namespace

void SceneHistory::note(const v1::SceneChanged& before, const v1::SceneChanged& after,
                        std::uint32_t run) {
    run_since_ = run == run_ ? run_since_ : after.epoch();
    run_ = run;
    auto& states = states_[subject_of(after)];
    if (states.empty()) {
        states.push_back(before);
        states.back().set_epoch(oldest_);
    }
    newest_ = after.epoch();
    if (run != 0 && states.size() > 1 && states.back().epoch() >= run_since_) {
        states.back() = after;
        return;
    }
    states.push_back(after);
    if (++changes_ > max_changes) {
        forget_oldest();
    }
}

/// Half of the changes, so that it is seldom to be done.
void SceneHistory::forget_oldest() {
    std::vector<std::uint32_t> epochs;
    for (const auto& [subject, states] : states_) {
        for (std::size_t i = 1; i < states.size(); ++i) {
            epochs.push_back(states[i].epoch());
        }
    }
    const auto middle = epochs.begin() + static_cast<std::ptrdiff_t>(epochs.size() / 2);
    std::nth_element(epochs.begin(), middle, epochs.end());
    oldest_ = *middle;
    changes_ = 0;
    for (auto& [subject, states] : states_) {
        const auto later =
            std::find_if(states.begin() + 1, states.end(),
                         [this](const v1::SceneChanged& state) { return state.epoch() > oldest_; });
        states.erase(states.begin(), std::prev(later));
        changes_ += states.size() - 1;
    }
}

std::optional<std::vector<v1::SceneChanged>> SceneHistory::back_to(std::uint32_t epoch) const {
    if (epoch < oldest_ || epoch > newest_) {
        return std::nullopt;
    }
    std::vector<v1::SceneChanged> changes;
    for (const auto& [subject, states] : states_) {
        const v1::SceneChanged& wanted = state_at(states, epoch);
        if (!same_state(wanted, states.back())) {
            changes.push_back(wanted);
        }
    }
    // It brings its lights undimmed; what they were dimmed to comes after it. What is there again
    // is there before it is changed.
    std::stable_partition(changes.begin(), changes.end(), [](const v1::SceneChanged& c) {
        return c.has_set_daylight() || c.has_add_object() || c.has_add_luminaire();
    });
    return changes;
}

}  // namespace raybundle
