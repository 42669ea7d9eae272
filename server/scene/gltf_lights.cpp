// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_lights.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace raybundle {
namespace {

constexpr const char* extension_name = "KHR_lights_punctual";
constexpr std::size_t max_lights = 256;  // each keeps shadow maps on the GPU

PunctualKind kind_of(const std::string& type) {
    if (type == "spot") {
        return PunctualKind::spot;
    }
    return type == "directional" ? PunctualKind::directional : PunctualKind::point;
}

class LightReader {
  public:
    LightReader(GltfDocument& document, const GltfNodeTree& tree,
                const std::vector<ObjectPlan>& plans, Scene& scene)
        : document_(document),
          tree_(tree),
          scene_(scene),
          object_of_node_(tree.nodes.size(), PunctualLight::no_object) {
        for (std::size_t i = 0; i < plans.size(); ++i) {
            object_of_node_[static_cast<std::size_t>(plans[i].node)] = static_cast<int>(i);
        }
        if (const Json* extension = document.extension(extension_name)) {
            definitions_ = array_or_empty(*extension, "lights");
        }
    }

    void read() {
        for (const int index : tree_.order) {
            const auto n = static_cast<std::size_t>(index);
            const int parent = tree_.nodes[n].parent;
            if (object_of_node_[n] == PunctualLight::no_object && parent >= 0) {
                object_of_node_[n] = object_of_node_[static_cast<std::size_t>(parent)];
            }
            const tinygltf::Value* use =
                find_extension(item(document_.model().nodes, index).extensions, extension_name);
            if (use != nullptr && tree_.nodes[n].visible) {
                add(n, static_cast<std::size_t>(integer_or(*use, "light", 0)));
            }
        }
    }

  private:
    void add(std::size_t node, std::size_t definition) {
        const std::string path = item_path("nodes", node) + ".extensions.KHR_lights_punctual.light";
        if (definition >= definitions_.size()) {
            document_.fail(path, fmt::format("{} is out of range: the file has {} lights",
                                             definition, definitions_.size()));
        }
        if (scene_.punctual_lights.size() >= max_lights) {
            document_.fail(path, fmt::format("more than {} punctual lights", max_lights));
        }
        const Json& source = definitions_[definition];
        PunctualLight light;
        light.kind = kind_of(source["type"].get<std::string>());
        light.name = tree_.nodes[node].name.empty() ? value_or<std::string>(source, "name", "")
                                                    : tree_.nodes[node].name;
        if (light.name.empty()) {
            light.name = fmt::format("light {}", scene_.punctual_lights.size() + 1);
        }
        for (int c = 0; c < 3; ++c) {
            const Json* colour = find_member(source, "color");
            const float factor =
                colour == nullptr ? 1.0F : (*colour)[static_cast<std::size_t>(c)].get<float>();
            light.intensity[c] = value_or(source, "intensity", 1.0F) * factor;
        }
        if (light.kind == PunctualKind::spot) {
            read_cone(source, definition, light);
        }
        if (find_member(source, "range") != nullptr) {
            document_.note("the range of lights is ignored: light reaches as far as it does");
        }
        place(node, light);
        if (light.intensity != glm::vec3(0.0F)) {
            scene_.punctual_lights.push_back(light);
        }
    }

    void read_cone(const Json& source, std::size_t definition, PunctualLight& light) {
        const Json none = Json::object();
        const Json* found = find_member(source, "spot");
        const Json& spot = found == nullptr ? none : *found;
        const double inner = value_or(spot, "innerConeAngle", 0.0);
        const double outer = value_or(spot, "outerConeAngle", glm::quarter_pi<double>());
        if (!(inner < outer)) {
            document_.fail(
                fmt::format("extensions.KHR_lights_punctual.lights[{}].spot", definition),
                fmt::format("innerConeAngle {} is not below outerConeAngle {}", inner, outer));
        }
        light.inner_cosine = static_cast<float>(std::cos(inner));
        // At least a thousandth apart, as the extension's own formula has it.
        light.outer_cosine =
            std::min(static_cast<float>(std::cos(outer)), light.inner_cosine - 1e-3F);
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
    Scene& scene_;
    std::vector<int> object_of_node_;  // index into Scene::objects
    Json definitions_ = Json::array();
};

}  // namespace

void read_punctual_lights(GltfDocument& document, const GltfNodeTree& tree,
                          const std::vector<ObjectPlan>& plans, Scene& scene) {
    LightReader(document, tree, plans, scene).read();
}

}  // namespace raybundle
