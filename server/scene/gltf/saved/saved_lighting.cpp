// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/saved_lighting.h"

#include <algorithm>
#include <optional>

#include "scene/gltf/saved/saved_values.h"
#include "scene/light/environment.h"

namespace raybundle {
namespace {

constexpr std::size_t max_lighting_scenes = 64;
constexpr std::size_t max_lighting_name = 200;

std::optional<std::size_t> index_of(const Json& json, const char* key) {
    const Json* found = find_member(json, key);
    return found != nullptr && found->is_number_unsigned()
               ? std::optional(found->get<std::size_t>())
               : std::nullopt;
}

std::string name_of(const Json& json, const char* key) {
    const std::string text = text_of(json, key).value_or("");
    return text.size() <= max_lighting_name ? text : "";
}

class LampReader {
  public:
    LampReader(const std::vector<LightSource>& sources, const Scene& scene)
        : sources_(sources), scene_(scene) {}

    [[nodiscard]] std::optional<SavedLightingScene::Lamp> lamp(const Json& json) const {
        const auto light = json.is_object() ? light_of(json) : std::nullopt;
        const auto intensity =
            light ? number_in(json, "intensity", 0.0F, max_saved_number) : std::nullopt;
        const auto colour =
            light ? vector_of(json, "colour", 0.0F, max_saved_number) : std::nullopt;
        const auto on = light ? flag_of(json, "on") : std::nullopt;
        if (!intensity || !colour || !on || !(luminance(*colour) > 0.0F)) {
            return std::nullopt;
        }
        SavedLightingScene::Lamp lamp;
        lamp.light = *light;
        lamp.intensity = *intensity;
        lamp.colour = *colour;
        lamp.on = *on;
        lamp.dim = number_in(json, "dim", 0.0F, 1.0F).value_or(1.0F);
        return lamp;
    }

  private:
    /// Light::id of what the lamp is.
    [[nodiscard]] std::optional<std::uint32_t> light_of(const Json& json) const {
        if (const auto material = index_of(json, "material")) {
            const auto found =
                std::find_if(scene_.lights.begin(), scene_.lights.end(), [&](const Light& light) {
                    return light.material >= 0 &&
                           static_cast<std::size_t>(light.material) == *material;
                });
            return found == scene_.lights.end() ? std::nullopt : std::optional(found->id);
        }
        const auto node = index_of(json, "node");
        const bool photometric = flag_of(json, "photometric").value_or(false);
        for (std::size_t i = 0; node && i < sources_.size(); ++i) {
            if (sources_[i].node == *node && sources_[i].definition.has_value() != photometric) {
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
        one.name = name_of(saved[i], "name");
        one.by_name = name_of(saved[i], "byName");
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
