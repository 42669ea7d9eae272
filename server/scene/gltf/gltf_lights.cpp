// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

#include "scene/gltf/file/gltf_uri.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

constexpr const char* extension_name = "KHR_lights_punctual";
constexpr const char* ies_extension = "EXT_lights_ies";
constexpr std::uint64_t max_profile_bytes = 16ULL << 20U;

PunctualKind kind_of(const std::string& type) {
    if (type == "spot") {
        return PunctualKind::spot;
    }
    return type == "directional" ? PunctualKind::directional : PunctualKind::point;
}

class LightReader {
  public:
    LightReader(GltfDocument& document, const GltfNodeTree& tree,
                const std::vector<ObjectPlan>& plans, const std::vector<bool>& moved, Scene& scene)
        : document_(document),
          tree_(tree),
          moved_(moved),
          scene_(scene),
          object_of_node_(tree.nodes.size(), PunctualLight::no_object) {
        for (std::size_t i = 0; i < plans.size(); ++i) {
            object_of_node_[static_cast<std::size_t>(plans[i].node)] = static_cast<int>(i);
        }
        if (const Json* extension = document.extension(extension_name)) {
            definitions_ = array_or_empty(*extension, "lights");
        }
        if (const Json* extension = document.extension(ies_extension)) {
            profiles_ = array_or_empty(*extension, "lights");
        }
        read_profiles_.resize(profiles_.size());
    }

    std::vector<LightSource> read() {
        for (const int index : tree_.order) {
            const auto n = static_cast<std::size_t>(index);
            const int parent = tree_.nodes[n].parent;
            const bool inherits = parent >= 0 && !moved_[n];
            if (object_of_node_[n] == PunctualLight::no_object && inherits) {
                object_of_node_[n] = object_of_node_[static_cast<std::size_t>(parent)];
            }
            if (!tree_.nodes[n].visible) {
                continue;
            }
            const tinygltf::ExtensionMap& extensions =
                item(document_.model().nodes, index).extensions;
            if (const auto* use = find_extension(extensions, extension_name)) {
                add(n, static_cast<std::size_t>(integer_or(*use, "light", 0)));
            }
            if (const auto* use = find_extension(extensions, ies_extension)) {
                add_profile(n, *use);
            }
        }
        sort_saved();
        return std::move(sources_);
    }

  private:
    /// Lights of a saved scene have the order that they had.
    void sort_saved() {
        std::vector<std::size_t> order(sources_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
            return sources_[a].number < sources_[b].number;
        });
        std::vector<LightSource> sources;
        std::vector<PunctualLight> lights;
        for (const std::size_t i : order) {
            sources.push_back(sources_[i]);
            lights.push_back(std::move(scene_.punctual_lights[i]));
        }
        sources_ = std::move(sources);
        scene_.punctual_lights = std::move(lights);
    }

    /// Takes up what a saved scene says of the light that has been read last.
    void restore(std::size_t node, const char* key, PunctualLight& light) {
        const SavedState& saved = document_.saved();
        sources_.back().number = saved_light_number(saved, static_cast<int>(node), key);
        restore_light(saved, static_cast<int>(node), key, light);
    }

    void add(std::size_t node, std::size_t definition) {
        const std::string path = item_path("nodes", node) + ".extensions.KHR_lights_punctual.light";
        check_index(path, definition, definitions_.size());
        const Json& source = definitions_[definition];
        PunctualLight light;
        light.kind = kind_of(source["type"].get<std::string>());
        light.name = name_of(node, source);
        glm::vec3 colour(1.0F);
        if (const Json* values = find_member(source, "color")) {
            for (int c = 0; c < 3; ++c) {
                colour[c] = (*values)[static_cast<std::size_t>(c)].get<float>();
            }
        }
        set_intensity(value_or(source, "intensity", 1.0F), colour, light);
        LightSource of_file{node, definition};
        of_file.intensity = value_or(source, "intensity", 1.0F);
        of_file.colour = colour;
        sources_.push_back(of_file);
        if (light.kind == PunctualKind::spot) {
            read_cone(source, definition, light);
        }
        if (find_member(source, "range") != nullptr) {
            light.range = value_or(source, "range", 0.0F);
            document_.note("the range of lights cuts nothing off: light reaches as far as it does");
        }
        place(node, light);
        restore(node, SavedLight::punctual, light);
        scene_.punctual_lights.push_back(std::move(light));
    }

    /// One that is dark in the file can be switched on, in its colour.
    static void set_intensity(float factor, const glm::vec3& colour, PunctualLight& light) {
        light.intensity = factor * colour;
        light.dark_colour = luminance(colour) > 0.0F ? colour / luminance(colour) : glm::vec3(1.0F);
    }

    void add_profile(std::size_t node, const tinygltf::Value& use) {
        const std::string path = item_path("nodes", node) + ".extensions.EXT_lights_ies.light";
        const auto index = static_cast<std::size_t>(integer_or(use, "light", 0));
        check_index(path, index, profiles_.size());
        PunctualLight light;
        light.name = name_of(node, profiles_[index]);
        set_intensity(number_or(use, "multiplier", 1.0F),
                      glm::min(vector_or(use, "color", glm::vec3(1.0F)), 1.0F), light);
        light.profile = profile(index);
        light.photometry = file_name(value_or<std::string>(profiles_[index], "uri", ""));
        sources_.push_back({node, std::nullopt});
        place(node, light);
        restore(node, SavedLight::photometric, light);
        scene_.punctual_lights.push_back(std::move(light));
    }

    /// Of a file's uri; empty where the bytes are in the uri itself.
    static std::string file_name(const std::string& uri) {
        return uri.starts_with("data:") ? "" : uri.substr(uri.find_last_of('/') + 1);
    }

    std::shared_ptr<const IesProfile> profile(std::size_t index) {
        if (read_profiles_[index]) {
            return read_profiles_[index];
        }
        const std::string path = fmt::format("extensions.EXT_lights_ies.lights[{}]", index);
        const Json& source = profiles_[index];
        std::vector<std::uint8_t> bytes;
        if (const Json* uri = find_member(source, "uri")) {
            bytes = read_uri(document_.path(), path + ".uri", uri->get<std::string>(),
                             max_profile_bytes);
        } else if (const int view = value_or(source, "bufferView", -1); view >= 0) {
            const auto span = document_.view_bytes(view);
            bytes.assign(span.begin(), span.end());
        } else {
            document_.fail(path, "has neither a uri nor a bufferView");
        }
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        try {
            read_profiles_[index] =
                std::make_shared<const IesProfile>(parse_photometry(document_.path(), text));
        } catch (const SceneError& error) {
            document_.fail(path, error.json_path() + ": " + error.reason());
        }
        for (const std::string& note : read_profiles_[index]->data().notes) {
            document_.note(fmt::format("photometry '{}': {}",
                                       value_or<std::string>(source, "uri", path), note));
        }
        return read_profiles_[index];
    }

    void check_index(const std::string& path, std::size_t index, std::size_t count) const {
        if (index >= count) {
            document_.fail(path,
                           fmt::format("{} is out of range: the file has {} lights", index, count));
        }
    }

    [[nodiscard]] std::string name_of(std::size_t node, const Json& source) const {
        std::string name = tree_.nodes[node].name;
        if (name.empty()) {
            name = value_or<std::string>(source, "name", "");
        }
        return name.empty() ? fmt::format("light {}", scene_.punctual_lights.size() + 1) : name;
    }

    void read_cone(const Json& source, std::size_t definition, PunctualLight& light) {
        const Json none = Json::object();
        const Json* found = find_member(source, "spot");
        const Json& spot = found == nullptr ? none : *found;
        const double inner = value_or(spot, "innerConeAngle", 0.0);
        const double outer = value_or(spot, "outerConeAngle", glm::quarter_pi<double>());
        constexpr double rounding = 1e-4;  // of programs that store cones in other ways
        if (inner > outer + rounding) {
            document_.note(fmt::format(
                "extensions.KHR_lights_punctual.lights[{}].spot: innerConeAngle {:.6g} is above "
                "outerConeAngle {:.6g}: the outer cone gets a hard edge",
                definition, inner, outer));
        }
        // A hard edge has both cones at once: it falls within 16 roundings of a cosine.
        constexpr float min_gap = 16.0F * std::numeric_limits<float>::epsilon();
        light.outer_cosine = std::min(static_cast<float>(std::cos(outer)), 1.0F - min_gap);
        light.inner_cosine =
            std::max(static_cast<float>(std::cos(inner)), light.outer_cosine + min_gap);
    }

    void place(std::size_t node, PunctualLight& light) const {
        glm::dmat4 placed = tree_.nodes[node].world_from_node;
        light.object = object_of_node_[node];
        if (light.object != PunctualLight::no_object) {
            const auto object = static_cast<std::size_t>(light.object);
            const glm::dmat4 world(scene_.objects[object].world_from_object());
            if (glm::determinant(world) == 0.0) {
                light.object = PunctualLight::no_object;
            } else {
                placed = glm::inverse(world) * placed;
            }
        }
        light.position = glm::vec3(placed[3]);
        light.axes = glm::mat3(glm::dmat3(placed));
    }

    GltfDocument& document_;
    const GltfNodeTree& tree_;
    const std::vector<bool>& moved_;
    Scene& scene_;
    std::vector<LightSource> sources_;
    std::vector<int> object_of_node_;  // index into Scene::objects
    Json definitions_ = Json::array();
    Json profiles_ = Json::array();
    std::vector<std::shared_ptr<const IesProfile>> read_profiles_;  // where one has been used
};

}  // namespace

std::vector<LightSource> read_punctual_lights(GltfDocument& document, const GltfNodeTree& tree,
                                              const std::vector<ObjectPlan>& plans,
                                              const std::vector<bool>& moved, Scene& scene) {
    return LightReader(document, tree, plans, moved, scene).read();
}

}  // namespace raybundle
