// SPDX-License-Identifier: Apache-2.0
#include "session/changes/lighting_scenes.h"

#include <algorithm>
#include <set>
#include <utility>

#include "session/messages/light_messages.h"
#include "session/messages/scene_messages.h"

namespace raybundle {
namespace {

/// The number of what the journal does not hold.
constexpr std::uint32_t of_file = 0;

/// What a lighting scene sets: not where lights are, nor what groups they belong to.
v1::SetLight setting_of_light(const Scene& scene, std::uint32_t id) {
    const v1::SetLight state = state_of_light(scene, id);
    v1::SetLight setting;
    setting.set_light(id);
    setting.set_intensity(state.intensity());
    *setting.mutable_colour() = state.colour();
    setting.set_on(state.on());
    if (state.has_dim()) {
        setting.set_dim(state.dim());
    }
    return setting;
}

}  // namespace

LightingScenes::LightingScenes(ChangeLog& log) : log_(log) {
    for (const std::string& body : log.notes(NoteKind::lighting_scene)) {
        v1::JournalLightingScene content;
        if (content.ParseFromString(body)) {
            next_number_ = std::max(next_number_, content.number() + 1);
            const std::string name = content.scene().name();
            scenes_[name] = std::move(content);
        }
    }
}

void LightingScenes::take_up(const Scene& scene) {
    for (const SavedLightingScene& loaded : scene.lighting_scenes) {
        v1::JournalLightingScene content;
        content.mutable_scene()->set_name(loaded.name);
        content.mutable_scene()->set_by_name(loaded.by_name);
        for (const SavedLightingScene::Lamp& lamp : loaded.lamps) {
            v1::SetLight& light = *content.add_lights();
            light.set_light(lamp.light);
            light.set_intensity(lamp.intensity);
            to_message(lamp.colour, light.mutable_colour());
            light.set_on(lamp.on);
            light.set_dim(lamp.dim);
        }
        scenes_.emplace(loaded.name, std::move(content));
    }
}

std::vector<SavedLightingScene> LightingScenes::saved() const {
    std::vector<SavedLightingScene> result;
    for (const auto& [name, content] : scenes_) {
        SavedLightingScene& one = result.emplace_back();
        one.name = name;
        one.by_name = content.scene().by_name();
        for (const v1::SetLight& light : content.lights()) {
            one.lamps.push_back({light.light(), from_message(light.colour()), light.intensity(),
                                 light.has_dim() ? light.dim() : 1.0F, light.on()});
        }
    }
    return result;
}

v1::ServerMessage LightingScenes::follow(std::uint32_t number, const std::string& body) {
    v1::ServerMessage news;
    v1::JournalLightingScene content;
    if (!body.empty() && content.ParseFromString(body)) {
        next_number_ = std::max(next_number_, number + 1);
        news.mutable_lighting_scene_changed()->set_name(content.scene().name());
        news.mutable_lighting_scene_changed()->set_by_name(content.scene().by_name());
        const std::string name = content.scene().name();
        scenes_[name] = std::move(content);
        return news;
    }
    const auto known = std::find_if(scenes_.begin(), scenes_.end(), [number](const auto& scene) {
        return scene.second.number() == number;
    });
    if (body.empty() && known != scenes_.end()) {
        news.mutable_lighting_scene_changed()->set_name(known->first);
        news.mutable_lighting_scene_changed()->set_removed(true);
        scenes_.erase(known);
    }
    return news;
}

bool LightingScenes::refuse(v1::Error::Code code, const std::string& reason) {
    refusal_.set_code(code);
    refusal_.set_message(reason);
    return false;
}

bool LightingScenes::save(const std::string& name, const std::string& by_name, const Scene& scene,
                          const std::string& key) {
    const auto known = scenes_.find(name);
    if (known == scenes_.end() && scenes_.size() >= max_scenes) {
        return refuse(v1::Error::RESOURCE_EXHAUSTED,
                      "saveLightingScene: there are 64, remove some");
    }
    v1::JournalLightingScene saved;
    const auto number = known == scenes_.end() || known->second.number() == of_file
                            ? log_.new_number(NoteKind::lighting_scene, next_number_)
                            : std::optional(known->second.number());
    saved.set_number(number.value_or(0));
    saved.mutable_scene()->set_name(name);
    saved.mutable_scene()->set_by_name(by_name);
    for (const std::uint32_t id : light_numbers(scene)) {
        if (is_lamp(scene, id)) {
            *saved.add_lights() = setting_of_light(scene, id);
        }
    }
    if (!number ||
        !log_.keep_note(NoteKind::lighting_scene, *number, saved.SerializeAsString(), key)) {
        refusal_ = log_.refusal("the lighting scene could not be saved");
        return false;
    }
    next_number_ = std::max(next_number_, saved.number() + 1);
    scenes_[name] = std::move(saved);
    return true;
}

bool LightingScenes::remove(const std::string& name) {
    const auto known = scenes_.find(name);
    if (known == scenes_.end()) {
        return refuse(v1::Error::NOT_FOUND,
                      "removeLightingScene.name: no lighting scene '" + name + "'");
    }
    if (known->second.number() != of_file &&
        !log_.keep_note(NoteKind::lighting_scene, known->second.number(), {})) {
        refusal_ = log_.refusal("the removal could not be saved");
        return false;
    }
    scenes_.erase(known);
    return true;
}

std::optional<std::vector<v1::SceneChanged>> LightingScenes::changes_to(const std::string& name,
                                                                        const Scene& scene) const {
    const auto known = scenes_.find(name);
    if (known == scenes_.end()) {
        return std::nullopt;
    }
    const std::vector<std::uint32_t> present = light_numbers(scene);
    const std::set<std::uint32_t> numbers(present.begin(), present.end());
    std::vector<v1::SceneChanged> changes;
    for (const v1::SetLight& wanted : known->second.lights()) {
        const bool exists = numbers.contains(wanted.light()) && is_lamp(scene, wanted.light());
        if (!exists || !problem_of(scene, wanted).empty() ||
            setting_of_light(scene, wanted.light()).SerializeAsString() ==
                wanted.SerializeAsString()) {
            continue;
        }
        *changes.emplace_back().mutable_set_light() = wanted;
    }
    return changes;
}

void LightingScenes::describe(v1::Scene* message) const {
    for (const auto& [name, saved] : scenes_) {
        *message->add_lighting_scenes() = saved.scene();
    }
}

}  // namespace raybundle
