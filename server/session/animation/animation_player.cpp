// SPDX-License-Identifier: Apache-2.0
#include "session/animation/animation_player.h"

#include <algorithm>
#include <cmath>

#include "session/animation/animation_changes.h"

namespace raybundle {
namespace {

// What one viewer does with an animation within it is one step of undo, as of a slider that is held
// (protocol/raybundle.proto).
constexpr double run_pause_ms = 2000.0;
constexpr std::size_t max_stands = 1000;  // as many as ChangeRecords keeps

bool shares(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    return std::any_of(a.begin(), a.end(), [&b](std::uint32_t item) {
        return std::binary_search(b.begin(), b.end(), item);
    });
}

bool moves_same(const Animation& a, const Animation& b) {
    return shares(a.objects, b.objects) || shares(a.lights, b.lights) ||
           shares(a.materials, b.materials);
}

bool concerns(const Animation& animation, const v1::SceneChanged& change) {
    const auto [kind, id] = subject_of(change);
    switch (kind) {
        case v1::SceneChanged::kMoveObject:
        case v1::SceneChanged::kAddObject:  // comes or goes
            return id >= 1 &&
                   std::binary_search(animation.objects.begin(), animation.objects.end(), id - 1);
        case v1::SceneChanged::kSetLight:
        case v1::SceneChanged::kAddLuminaire:
            return std::binary_search(animation.lights.begin(), animation.lights.end(), id);
        case v1::SceneChanged::kSetMaterial:
            return std::binary_search(animation.materials.begin(), animation.materials.end(), id);
        default:
            return false;
    }
}

}  // namespace

AnimationPlayer::AnimationPlayer(const Scene& scene, const Clock& clock)
    : scene_(scene),
      clock_(clock),
      states_(scene.animations ? scene.animations->animations.size() : 0) {}

const Animation& AnimationPlayer::animation(std::size_t index) const {
    return scene_.animations->animations[index];
}

void AnimationPlayer::restore(const std::vector<v1::AnimationStep>& steps) {
    for (const v1::AnimationStep& step : steps) {
        const std::size_t index = find_animation(scene_, step.animation());
        if (index < states_.size()) {
            states_[index].seconds = states_[index].shown = step.seconds();
            touch(index);
        }
    }
}

v1::Error AnimationPlayer::problem_of(const v1::PlayAnimation& request) const {
    v1::Error problem;
    if (find_animation(scene_, request.animation()) >= states_.size()) {
        problem.set_code(v1::Error::NOT_FOUND);
        problem.set_message("playAnimation.animation: no animation '" + request.animation() +
                            "'; there are: " + animation_names(scene_));
    } else if (only_deforms(animation(index_of(request)))) {
        problem.set_code(v1::Error::NOT_FOUND);
        problem.set_message("playAnimation.animation: '" + request.animation() +
                            "' does nothing but deform objects, which keep their shape here");
    }
    return problem;
}

std::size_t AnimationPlayer::index_of(const v1::PlayAnimation& request) const {
    return find_animation(scene_, request.animation());
}

/// Where an animation is by now.
double AnimationPlayer::place_of(std::size_t index, bool& ended) const {
    const State& state = states_[index];
    const double length = animation(index).seconds;
    ended = false;
    if (!state.playing) {
        return state.seconds;
    }
    const double place = state.seconds + state.speed * clock_.ms_since(state.since) / 1000.0;
    if (state.loop && length > 0.0) {
        const double wrapped = std::fmod(place, length);
        return wrapped < 0.0 ? wrapped + length : wrapped;
    }
    ended = state.speed > 0.0 ? place >= length : state.speed < 0.0 && place <= 0.0;
    return std::clamp(place, 0.0, length);
}

/// Counts from now on.
void AnimationPlayer::settle(std::size_t index) {
    bool ended = false;
    states_[index].seconds = place_of(index, ended);
    states_[index].since = clock_.now();
}

void AnimationPlayer::begin_run(std::size_t index, std::uint32_t by, const std::string& by_name) {
    State& state = states_[index];
    const bool goes_on =
        state.playing || (state.by == by && clock_.ms_since(state.touched) < run_pause_ms);
    if (!goes_on) {
        state.first_epoch = 0;
        state.moved.clear();
    }
    if (!state.playing || state.first_epoch == 0) {
        state.by = by;
        state.by_name = by_name;
    }
    state.left.clear();
    state.touched = clock_.now();
}

std::vector<std::size_t> AnimationPlayer::play(const v1::PlayAnimation& request, std::uint32_t by,
                                               const std::string& by_name) {
    const std::size_t index = index_of(request);
    State& state = states_[index];
    begin_run(index, by, by_name);
    settle(index);
    state.loop = request.has_loop() ? request.loop() : state.loop;
    state.speed = request.has_speed() ? double{request.speed()} : state.speed;
    const bool start = request.has_playing() && request.playing() && !state.playing;
    state.playing = request.has_playing() ? request.playing() : state.playing;
    const double length = animation(index).seconds;
    if (request.has_seconds()) {
        state.seconds = std::min(double{request.seconds()}, length);
    } else if (start && !state.loop && state.speed != 0.0) {
        const double end = state.speed > 0.0 ? length : 0.0;
        state.seconds = state.seconds == end ? length - end : state.seconds;
    }
    state.due = !state.playing;
    std::vector<std::size_t> changed{index};
    for (std::size_t other = 0; state.playing && other < states_.size(); ++other) {
        if (other != index && states_[other].playing &&
            moves_same(animation(index), animation(other))) {
            stop(other);
            changed.push_back(other);
        }
    }
    return changed;
}

/// Where the last step has brought it.
void AnimationPlayer::stop(std::size_t index) {
    State& state = states_[index];
    state.playing = false;
    state.due = false;
    state.seconds = state.shown;
}

std::vector<std::size_t> AnimationPlayer::make_way(const v1::SceneChanged& change) {
    std::vector<std::size_t> paused;
    for (std::size_t i = 0; i < states_.size(); ++i) {
        State& state = states_[i];
        if ((state.playing || state.due) && concerns(animation(i), change)) {
            state.left.insert(subject_of(change));
            if (state.playing) {
                stop(i);
                state.due = true;  // what else it has moved comes to rest
                paused.push_back(i);
            }
        }
    }
    return paused;
}

bool AnimationPlayer::playing() const {
    return std::any_of(states_.begin(), states_.end(), [](const State& s) { return s.playing; });
}

std::vector<std::size_t> AnimationPlayer::stop_all() {
    std::vector<std::size_t> stopped;
    for (std::size_t i = 0; i < states_.size(); ++i) {
        if (states_[i].playing) {
            stopped.push_back(i);
        }
        if (states_[i].playing || states_[i].due) {
            stop(i);
        }
    }
    return stopped;
}

void AnimationPlayer::note_undo(std::uint32_t epoch) {
    for (State& state : states_) {
        const auto later = std::find_if(state.stands.begin(), state.stands.end(),
                                        [epoch](const auto& s) { return s.first > epoch; });
        if (later == state.stands.end() || later == state.stands.begin()) {
            continue;  // it stands as it stood
        }
        state.seconds = state.shown = std::prev(later)->second;
        state.first_epoch = 0;
        state.moved.clear();
    }
}

void AnimationPlayer::touch(std::size_t index) {
    std::erase(touched_, index);
    touched_.push_back(index);
}

std::vector<AnimationPlace> AnimationPlayer::places(std::size_t last, double seconds) const {
    std::vector<AnimationPlace> result;
    for (const std::size_t other : touched_) {
        if (other != last) {
            result.push_back({other, states_[other].shown});
        }
    }
    result.push_back({last, seconds});
    return result;
}

/// Changes towards where one animation is.
std::vector<v1::SceneChanged> AnimationPlayer::step_of(std::size_t index) {
    State& state = states_[index];
    bool ended = false;
    const double seconds = place_of(index, ended);
    const bool last = ended || !state.playing;
    std::vector<v1::SceneChanged> changes =
        changes_to(scene_, places(index, seconds), last ? state.moved : std::set<std::uint32_t>());
    std::erase_if(changes, [&state](const v1::SceneChanged& change) {
        return state.left.contains(subject_of(change));
    });
    if (ended) {
        state.playing = false;
        state.seconds = seconds;
        ended_.push_back(index);
    }
    state.due = false;
    if (changes.empty()) {
        return changes;
    }
    for (v1::SceneChanged& change : changes) {
        if (change.has_move_object()) {
            change.mutable_move_object()->set_final(last);
            state.moved.insert(change.move_object().object() - 1);
        }
        change.set_by(state.by);
        change.set_by_name(state.by_name);
        change.mutable_animation()->set_animation(animation(index).name);
        change.mutable_animation()->set_seconds(static_cast<float>(seconds));
    }
    if (state.stands.empty()) {
        state.stands.emplace_back(0, state.shown);
    }
    state.shown = seconds;
    touch(index);
    return changes;
}

std::vector<v1::SceneChanged> AnimationPlayer::step(bool watched) {
    for (std::size_t n = 0; n < states_.size(); ++n) {
        const std::size_t index = (next_ + n) % states_.size();
        const State& state = states_[index];
        bool ended = false;
        (void)place_of(index, ended);
        if (!state.due && !ended && !(state.playing && watched)) {
            continue;
        }
        std::vector<v1::SceneChanged> changes = step_of(index);
        if (!changes.empty()) {
            next_ = index + 1;
            return changes;
        }
    }
    return {};
}

void AnimationPlayer::number(v1::SceneChanged& change, std::uint32_t epoch) const {
    const std::size_t index = find_animation(scene_, change.animation().animation());
    if (index < states_.size()) {
        const std::uint32_t first = states_[index].first_epoch;
        change.mutable_animation()->set_first_epoch(first == 0 ? epoch : first);
    }
}

void AnimationPlayer::note_recorded(const v1::SceneChanged& change, std::uint32_t epoch) {
    const std::size_t index = find_animation(scene_, change.animation().animation());
    if (index >= states_.size()) {
        return;
    }
    State& state = states_[index];
    const double seconds = change.animation().seconds();
    if (state.first_epoch == 0) {
        state.first_epoch = epoch;
        state.stands.emplace_back(epoch, seconds);
        if (state.stands.size() > max_stands) {
            state.stands.pop_front();
        }
    }
    if (!state.stands.empty()) {
        state.stands.back() = {epoch, seconds};
    }
    state.touched = clock_.now();
}

v1::PlayAnimation AnimationPlayer::state_of(std::size_t index) const {
    const State& state = states_[index];
    bool ended = false;
    v1::PlayAnimation message;
    message.set_animation(animation(index).name);
    message.set_playing(state.playing);
    message.set_seconds(static_cast<float>(place_of(index, ended)));
    message.set_speed(static_cast<float>(state.speed));
    message.set_loop(state.loop);
    return message;
}

void AnimationPlayer::describe(v1::Scene* message) const {
    for (std::size_t i = 0; i < states_.size(); ++i) {
        if (only_deforms(animation(i))) {
            continue;
        }
        v1::Animation* const out = message->add_animations();
        out->set_name(animation(i).name);
        out->set_seconds(static_cast<float>(animation(i).seconds));
        for (const std::uint32_t object : animation(i).objects) {
            out->add_objects(object + 1);
        }
        for (const std::uint32_t light : animation(i).lights) {
            out->add_lights(light);
        }
        for (const std::uint32_t material : animation(i).materials) {
            out->add_materials(material);
        }
        *out->mutable_state() = state_of(i);
    }
}

}  // namespace raybundle
