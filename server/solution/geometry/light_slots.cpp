// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/light_slots.h"

#include <algorithm>
#include <bit>

namespace raybundle {
namespace {

std::vector<PunctualLight> lights_of_file(const Scene& scene) {
    std::vector<PunctualLight> lights;
    for (const PunctualLight& light : scene.punctual_lights) {
        if (!light.added) {
            lights.push_back(light);
        }
    }
    return without_discs(lights);
}

std::vector<const PunctualLight*> added_ones(const Scene& scene) {
    std::vector<const PunctualLight*> lights;
    for (const PunctualLight& light : scene.punctual_lights) {
        if (light.added && !light.removed) {
            lights.push_back(&light);
        }
    }
    return lights;
}

bool any_added(const Scene& scene) {
    return std::any_of(scene.punctual_lights.begin(), scene.punctual_lights.end(),
                       [](const PunctualLight& light) { return light.added != nullptr; });
}

/// Room for as many more, so that n additions grow the tables log n times; but no shadow maps are
/// given up for lights that may never come.
std::size_t slots_for(std::size_t fixed, std::size_t added) {
    constexpr std::size_t fewest = 8;
    const std::size_t room = std::max(fewest, std::bit_ceil(2 * added));
    const std::size_t needed = fixed + added;
    return needed <= PunctualLight::most_mapped ? std::min(room, PunctualLight::most_mapped - fixed)
                                                : room;
}

PunctualLight empty_slot(const Scene& scene) {
    PunctualLight light;
    light.position = scene.bounds.empty() ? glm::vec3(0.0F) : scene.bounds.centre();
    return light;
}

}  // namespace

bool any_profile(const std::vector<PunctualLight>& lights) {
    return std::any_of(lights.begin(), lights.end(),
                       [](const PunctualLight& light) { return light.profile != nullptr; });
}

LightSlots::LightSlots(const Scene& scene) : lights_(lights_of_file(scene)) {
    fixed_ = lights_.size();
    if (any_added(scene)) {
        numbers_.resize(slots_for(fixed_, added_ones(scene).size()));
        lights_.resize(fixed_ + numbers_.size(), empty_slot(scene));
    }
    update(scene);
}

bool LightSlots::fit(const Scene& scene) const {
    return lights_of_file(scene).size() == fixed_ && added_ones(scene).size() <= numbers_.size();
}

void LightSlots::update(const Scene& scene) {
    const std::vector<PunctualLight> fixed = lights_of_file(scene);
    std::copy(fixed.begin(), fixed.end(), lights_.begin());
    std::vector<const PunctualLight*> waiting = added_ones(scene);
    const std::vector<std::uint32_t> before = numbers_;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        PunctualLight& slot = lights_[fixed_ + i];
        const auto same = std::find_if(waiting.begin(), waiting.end(), [&](const auto* light) {
            return light->added->number == numbers_[i];
        });
        if (same != waiting.end()) {
            slot = **same;
            waiting.erase(same);
        } else {
            slot.intensity = glm::vec3(0.0F);
            numbers_[i] = 0;
        }
    }
    // What has just been emptied is filled last: its light is still to be taken back.
    for (const bool emptied : {false, true}) {
        for (std::size_t i = 0; i < numbers_.size() && !waiting.empty(); ++i) {
            if (numbers_[i] == 0 && (before[i] != 0) == emptied) {
                lights_[fixed_ + i] = *waiting.front();
                numbers_[i] = waiting.front()->added->number;
                waiting.erase(waiting.begin());
            }
        }
    }
}

}  // namespace raybundle
