// SPDX-License-Identifier: Apache-2.0
#include "session/light_fades.h"

#include <algorithm>

#include "journal/change_sum.h"
#include "net/ws/rules/change_rules.h"
#include "scene/edit/light_edit.h"

namespace raybundle {

namespace {

float share_of(TimePoint begun, double duration, TimePoint now) {
    return static_cast<float>(std::clamp(seconds(now - begun) / duration, 0.0, 1.0));
}

}  // namespace

void LightFades::follow(const v1::SceneChanged& change, const LampOutputs& shown,
                        const Scene& scene, TimePoint now) {
    if (change.has_add_luminaire()) {  // has come or gone
        steps_ += fades_.erase(change.add_luminaire().light());
        return;
    }
    const v1::SetLight& set = change.set_light();
    const auto before = shown.find(set.light());
    if (!change.has_set_light() || !sets_light(set) || before == shown.end()) {
        return;
    }
    steps_ += fades_.erase(set.light());
    // Whoever wrote it may be another server.
    const double duration = std::min(double{set.fade_seconds()}, double{max_fade_seconds});
    if (duration > 0.0 && lamp_output(scene, set.light()) != before->second) {
        fades_[set.light()] = {before->second, now, duration, 0.0F};
    }
}

std::vector<std::uint32_t> LightFades::advance(TimePoint now) {
    std::vector<std::uint32_t> moved;
    for (auto& [lamp, fade] : fades_) {
        const float share = share_of(fade.begun, fade.seconds, now);
        if (share != fade.share) {
            fade.share = share;
            moved.push_back(lamp);
        }
    }
    std::erase_if(fades_, [](const auto& entry) { return entry.second.share >= 1.0F; });
    steps_ += moved.empty() ? 0 : 1;
    return moved;
}

bool LightFades::due(TimePoint now, bool watched) const {
    return std::any_of(fades_.begin(), fades_.end(), [now, watched](const auto& entry) {
        const Fade& fade = entry.second;
        const float share = share_of(fade.begun, fade.seconds, now);
        return share >= 1.0F || (watched && share != fade.share);
    });
}

std::vector<std::uint32_t> LightFades::lamps() const {
    std::vector<std::uint32_t> numbers;
    for (const auto& [lamp, fade] : fades_) {
        numbers.push_back(lamp);
    }
    return numbers;
}

LampOutputs LightFades::outputs(const Scene& scene) const {
    LampOutputs result;
    for (const auto& [lamp, fade] : fades_) {
        result[lamp] = glm::mix(fade.from, lamp_output(scene, lamp), fade.share);
    }
    return result;
}

void LightFades::describe(TimePoint now, v1::Scene* message) const {
    for (const auto& [lamp, fade] : fades_) {
        v1::LightFade* const out = message->add_fades();
        out->set_light(lamp);
        out->set_seconds(
            static_cast<float>(std::max(fade.seconds - seconds(now - fade.begun), 0.0)));
    }
}

ShownLamps::ShownLamps(Scene& scene, const LightFades& fades) : scene_(scene) {
    for (const auto& [lamp, output] : fades.outputs(scene)) {
        set_.emplace_back(lamp, lamp_output(scene, lamp));
        set_lamp_output(scene, lamp, output);
    }
}

ShownLamps::~ShownLamps() {
    for (const auto& [lamp, output] : set_) {
        set_lamp_output(scene_, lamp, output);
    }
}

}  // namespace raybundle
