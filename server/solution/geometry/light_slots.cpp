// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/light_slots.h"

#include <algorithm>
#include <bit>

namespace raybundle {
namespace {

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
/// given up for lights that may never come. each: lights in a slot.
std::size_t slots_for(std::size_t fixed, std::size_t added, std::size_t each) {
    constexpr std::size_t fewest = 8;
    const std::size_t room = std::max(fewest, std::bit_ceil(2 * added));
    return fixed + added * each <= PunctualLight::most_mapped
               ? std::min(room, (PunctualLight::most_mapped - fixed) / each)
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

LightSlots::LightSlots(const Scene& scene, double patch_length) : patch_length_(patch_length) {
    const std::vector<const PunctualLight*> added = added_ones(scene);
    for (const bool divided : {true, false}) {
        divides_ = divided;
        lights_ = lights_of_file(scene);
        fixed_ = lights_.size();
        slot_lights_ = any_large(added) ? LuminousOpening::parts : 1;
        const std::size_t slots =
            any_added(scene) ? slots_for(fixed_, added.size(), slot_lights_) : 0;
        numbers_.assign(slots, 0);
        if (fixed_ + slots * slot_lights_ <= PunctualLight::most_mapped) {
            break;  // else no light has a map, and rays look for their middles
        }
    }
    lights_.resize(fixed_ + numbers_.size() * slot_lights_, empty_slot(scene));
    update(scene);
}

bool LightSlots::is_large(const PunctualLight& light) const {
    const LuminousOpening opening = opening_of(light.profile.get());
    return divides_ && 2.0 * opening.largest_half() > patch_length_;
}

bool LightSlots::any_large(const std::vector<const PunctualLight*>& lights) const {
    return std::any_of(lights.begin(), lights.end(),
                       [this](const PunctualLight* light) { return is_large(*light); });
}

std::vector<PunctualLight> LightSlots::lights_of_file(const Scene& scene) const {
    std::vector<PunctualLight> lights;
    for (const PunctualLight& light : scene.punctual_lights) {
        if (light.added) {
            continue;
        }
        if (is_large(light)) {
            const std::vector<PunctualLight> parts = in_parts(light);
            lights.insert(lights.end(), parts.begin(), parts.end());
        } else {
            lights.push_back(light);
        }
    }
    return without_discs(lights);
}

bool LightSlots::fit(const Scene& scene) const {
    const std::vector<const PunctualLight*> added = added_ones(scene);
    return lights_of_file(scene).size() == fixed_ && added.size() <= numbers_.size() &&
           (slot_lights_ > 1 || !any_large(added));
}

/// A light that is not large takes the first place of its slot.
void LightSlots::put(std::size_t slot, const PunctualLight& light) {
    const std::size_t first = fixed_ + slot * slot_lights_;
    empty(slot);
    if (is_large(light)) {
        const std::vector<PunctualLight> parts = in_parts(light);
        std::copy(parts.begin(), parts.end(), lights_.begin() + static_cast<std::ptrdiff_t>(first));
    } else {
        lights_[first] = light;
    }
}

void LightSlots::empty(std::size_t slot) {
    for (std::size_t i = 0; i < slot_lights_; ++i) {
        PunctualLight& light = lights_[fixed_ + slot * slot_lights_ + i];
        light.intensity = glm::vec3(0.0F);
        light.removed = true;
    }
}

void LightSlots::update(const Scene& scene) {
    const std::vector<PunctualLight> fixed = lights_of_file(scene);
    std::copy(fixed.begin(), fixed.end(), lights_.begin());
    std::vector<const PunctualLight*> waiting = added_ones(scene);
    const std::vector<std::uint32_t> before = numbers_;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const auto same = std::find_if(waiting.begin(), waiting.end(), [&](const auto* light) {
            return light->added->number == numbers_[i];
        });
        if (same != waiting.end()) {
            put(i, **same);
            waiting.erase(same);
        } else {
            empty(i);
            numbers_[i] = 0;
        }
    }
    // What has just been emptied is filled last: its light is still to be taken back.
    for (const bool emptied : {false, true}) {
        for (std::size_t i = 0; i < numbers_.size() && !waiting.empty(); ++i) {
            if (numbers_[i] == 0 && (before[i] != 0) == emptied) {
                put(i, *waiting.front());
                numbers_[i] = waiting.front()->added->number;
                waiting.erase(waiting.begin());
            }
        }
    }
}

}  // namespace raybundle
