// SPDX-License-Identifier: Apache-2.0
#include "session/animation/animation_changes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "session/messages/light_messages.h"
#include "session/messages/scene_messages.h"

namespace raybundle {
namespace {

// What single precision loses of a number on its way through a message.
constexpr float message_rounding = 1e-6F;

bool differs(float a, float b) {
    return std::abs(a - b) > message_rounding * std::max({1.0F, std::abs(a), std::abs(b)});
}

bool differs(const glm::vec3& a, const glm::vec3& b) {
    return differs(a.x, b.x) || differs(a.y, b.y) || differs(a.z, b.z);
}

bool differs(const Transform& a, const Transform& b) {
    return a.translation != b.translation || a.rotation != b.rotation || a.scale != b.scale;
}

/// Takes over what differs from what is now.
void set_light(const LightEdit& edit, const v1::SetLight& now, v1::SetLight& set) {
    if (edit.intensity && differs(*edit.intensity, now.intensity())) {
        set.set_intensity(*edit.intensity);
    }
    if (edit.colour) {
        const glm::vec3 colour = *edit.colour / std::max(luminance(*edit.colour), 1e-30F);
        if (differs(colour, from_message(now.colour()))) {
            to_message(colour, set.mutable_colour());
        }
    }
    const bool moved = edit.position && differs(*edit.position, from_message(now.position()));
    const bool turned = (edit.aim && differs(*edit.aim, from_message(now.aim()))) ||
                        (edit.rotation && differs(*edit.rotation, now.rotation()));
    if (moved) {
        to_message(*edit.position, set.mutable_position());
    }
    if (turned) {
        to_message(*edit.aim, set.mutable_aim());
        set.set_rotation(*edit.rotation);
    }
    const bool shaped = (edit.inner_cone && differs(*edit.inner_cone, now.inner_cone())) ||
                        (edit.outer_cone && differs(*edit.outer_cone, now.outer_cone()));
    if (shaped && edit.inner_cone) {
        set.set_inner_cone(*edit.inner_cone);
    }
    if (shaped && edit.outer_cone) {
        set.set_outer_cone(*edit.outer_cone);
    }
}

/// Nothing where it is so already.
std::optional<v1::SceneChanged> change_of(const Scene& scene, const LightEdit& edit) {
    v1::SceneChanged change;
    v1::SetLight& set = *change.mutable_set_light();
    set.set_light(edit.light);
    const std::size_t empty = set.ByteSizeLong();
    set_light(edit, state_of_light(scene, edit.light), set);
    return set.ByteSizeLong() > empty ? std::optional(change) : std::nullopt;
}

std::optional<v1::SceneChanged> change_of(const Scene& scene, const MaterialEdit& edit) {
    const Material& now = scene.materials[edit.material - 1];
    v1::SceneChanged change;
    v1::SetMaterial& set = *change.mutable_set_material();
    set.set_material(edit.material);
    const std::size_t empty = set.ByteSizeLong();
    if (edit.base_colour && differs(*edit.base_colour, now.base_colour)) {
        to_message(*edit.base_colour, set.mutable_base_colour());
    }
    if (edit.roughness && differs(*edit.roughness, now.roughness)) {
        set.set_roughness(*edit.roughness);
    }
    if (edit.metallic && differs(*edit.metallic, now.metallic)) {
        set.set_metallic(*edit.metallic);
    }
    return set.ByteSizeLong() > empty ? std::optional(change) : std::nullopt;
}

}  // namespace

std::vector<v1::SceneChanged> changes_to(const Scene& scene, std::span<const AnimationPlace> places,
                                         const std::set<std::uint32_t>& always) {
    std::vector<v1::SceneChanged> changes;
    for (const auto& [object, place] : object_places(scene, places)) {
        if (always.contains(object) || differs(place, scene.objects[object].transform)) {
            v1::MoveObject& move = *changes.emplace_back().mutable_move_object();
            move.set_object(object + 1);
            to_message(place, move.mutable_transform());
        }
    }
    for (const LightEdit& edit : light_edits(scene, places)) {
        if (auto change = change_of(scene, edit)) {
            changes.push_back(std::move(*change));
        }
    }
    for (const MaterialEdit& edit : material_edits(scene, places)) {
        if (auto change = change_of(scene, edit)) {
            changes.push_back(std::move(*change));
        }
    }
    return changes;
}

}  // namespace raybundle
