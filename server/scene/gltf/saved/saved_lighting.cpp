// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/saved_lighting.h"

#include <algorithm>
#include <optional>

#include "scene/gltf/file/gltf_json.h"

namespace raybundle {
namespace {

constexpr std::size_t max_lighting_scenes = 64;
constexpr std::size_t max_lighting_name = 200;
constexpr double max_intensity = 1e12;

std::optional<double> lamp_number(const Json& json, const char* key, double high) {
    const Json* found = find_member(json, key);
    const bool good = found != nullptr && found->is_number() && found->get<double>() >= 0.0 &&
                      found->get<double>() <= high;
    return good ? std::optional(found->get<double>()) : std::nullopt;
}

std::string lighting_name(const Json& json, const char* key) {
    const Json* found = find_member(json, key);
    const bool good = found != nullptr && found->is_string() &&
                      found->get_ref<const std::string&>().size() <= max_lighting_name;
    return good ? found->get<std::string>() : "";
}

class LampReader {
  public:
    LampReader(const std::vector<LightSource>& sources, const Scene& scene)
        : sources_(sources), scene_(scene) {}

    [[nodiscard]] std::optional<SavedLightingScene::Lamp> lamp(const Json& json) const {
        const auto light = json.is_object() ? light_of(json) : std::nullopt;
        const auto intensity = light ? lamp_number(json, "intensity", max_intensity) : std::nullopt;
        const Json* colour = light ? find_member(json, "colour") : nullptr;
        const Json* on = light ? find_member(json, "on") : nullptr;
        const bool known = intensity && colour != nullptr && colour->is_array() &&
                           colour->size() == 3 && on != nullptr && on->is_boolean();
        if (!known) {
            return std::nullopt;
        }
        SavedLightingScene::Lamp lamp;
        lamp.light = *light;
        lamp.intensity = static_cast<float>(*intensity);
        lamp.on = on->get<bool>();
        lamp.dim = static_cast<float>(lamp_number(json, "dim", 1.0).value_or(1.0));
        for (int c = 0; c < 3; ++c) {
            const Json& value = (*colour)[static_cast<std::size_t>(c)];
            const bool good = value.is_number() && value.get<double>() >= 0.0 &&
                              value.get<double>() <= max_intensity;
            if (!good) {
                return std::nullopt;
            }
            lamp.colour[c] = value.get<float>();
        }
        return luminance(lamp.colour) > 0.0F ? std::optional(lamp) : std::nullopt;
    }

  private:
    /// Light::id of what the lamp is.
    [[nodiscard]] std::optional<std::uint32_t> light_of(const Json& json) const {
        if (const auto material = lamp_number(json, "material", 1e9)) {
            const auto found = std::find_if(
                scene_.lights.begin(), scene_.lights.end(),
                [&](const Light& light) { return double(light.material) == *material; });
            return found == scene_.lights.end() ? std::nullopt : std::optional(found->id);
        }
        const auto node = lamp_number(json, "node", 1e9);
        const Json* kind = find_member(json, "photometric");
        const bool photometric = kind != nullptr && kind->is_boolean() && kind->get<bool>();
        for (std::size_t i = 0; node && i < sources_.size(); ++i) {
            if (static_cast<double>(sources_[i].node) == *node &&
                sources_[i].definition.has_value() != photometric) {
                return static_cast<std::uint32_t>(scene_.lights.size() + i + 1);
            }
        }
        return std::nullopt;
    }

    const std::vector<LightSource>& sources_;
    const Scene& scene_;
};

}  // namespace

std::vector<SavedLightingScene> saved_lighting_scenes(const SavedState& state,
                                                      const std::vector<LightSource>& sources,
                                                      const Scene& scene) {
    std::vector<SavedLightingScene> scenes;
    const Json& saved = array_or_empty(state.scene, "lightingScenes");
    const LampReader reader(sources, scene);
    for (std::size_t i = 0; saved.is_array() && i < std::min(saved.size(), max_lighting_scenes);
         ++i) {
        if (!saved[i].is_object()) {
            continue;
        }
        SavedLightingScene& one = scenes.emplace_back();
        one.name = lighting_name(saved[i], "name");
        one.by_name = lighting_name(saved[i], "byName");
        const Json& lamps = array_or_empty(saved[i], "lamps");
        for (std::size_t k = 0; lamps.is_array() && k < lamps.size(); ++k) {
            if (const auto lamp = reader.lamp(lamps[k])) {
                one.lamps.push_back(*lamp);
            }
        }
        if (one.name.empty()) {
            scenes.pop_back();
        }
    }
    return scenes;
}

}  // namespace raybundle
