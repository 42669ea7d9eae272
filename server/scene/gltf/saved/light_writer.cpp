// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/light_writer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/gltf/gltf_loader.h"
#include "scene/gltf/saved/saved_state.h"
#include "scene/scene_folder.h"

namespace raybundle {
namespace {

constexpr const char* punctual_extension = "KHR_lights_punctual";
constexpr const char* photometric_extension = "EXT_lights_ies";
constexpr std::uint64_t max_profile_file = 16ULL << 20U;

/// As glTF has it: a colour of at most 1, and a factor.
std::pair<float, glm::vec3> factor_and_colour(const PunctualLight& light) {
    const glm::vec3& shining = light.intensity;
    const float most = std::max({shining.r, shining.g, shining.b});
    const glm::vec3 colour = most > 0.0F ? shining : setting_of(light).colour;
    const float top = std::max({colour.r, colour.g, colour.b, 1e-30F});
    return {most, colour / top};
}

glm::dmat4 matrix_of(const PunctualLight& light) {
    glm::dmat4 matrix{glm::dmat3(light.axes)};
    matrix[3] = glm::dvec4(glm::dvec3(light.position), 1.0);
    return matrix;
}

const Json* use_of(const Json& node, const char* extension) {
    const Json* extensions = find_member(node, "extensions");
    return extensions == nullptr ? nullptr : find_member(*extensions, extension);
}

}  // namespace

LightWriter::LightWriter(const SceneToSave& scene, const ObjectWriter& objects, NodeWriter& nodes,
                         GlbParts& parts)
    : scene_(scene), objects_(objects), nodes_(nodes), parts_(parts) {
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        drop_saved(nodes.at(static_cast<int>(n)), SavedLight::punctual);
        drop_saved(nodes.at(static_cast<int>(n)), SavedLight::photometric);
    }
}

void LightWriter::write() {
    for (std::size_t i = 0; i < scene_.source->light_sources.size(); ++i) {
        write_file_light(i);
    }
    for (const PunctualLight& light : scene_.punctual_lights) {
        if (light.added && !light.removed) {
            write_added(light);
        }
    }
}

void LightWriter::write_file_light(std::size_t index) {
    const PunctualLight& light = scene_.punctual_lights[index];
    const PunctualLight& before = scene_.source->lights[index];
    const LightSource& source = scene_.source->light_sources[index];
    const bool of_definition = source.definition.has_value();
    const char* const extension = of_definition ? punctual_extension : photometric_extension;
    const auto file_node = static_cast<int>(source.node);
    const Json* const found = use_of(nodes_.at(file_node), extension);
    const Json use = found == nullptr ? Json::object() : *found;
    const bool carrier_gone = light.object != PunctualLight::no_object &&
                              scene_.objects[static_cast<std::size_t>(light.object)].removed;
    if (light.removed || carrier_gone) {
        drop_extension(nodes_.at(file_node), extension);
        return;
    }
    const int node = place(index, file_node);
    const bool same_file = light.profile == before.profile && !(light.profile && of_definition);
    const bool same = same_file && light.intensity == before.intensity &&
                      light.inner_cosine == before.inner_cosine &&
                      light.outer_cosine == before.outer_cosine;
    if (!same || node != file_node) {
        drop_extension(nodes_.at(file_node), extension);
    }
    int at = node;
    if (same) {
        nodes_.at(at)["extensions"][extension] = use;
    } else {
        // A node has one light of a kind.
        const char* const wanted = light.profile ? photometric_extension : punctual_extension;
        at = use_of(nodes_.at(node), wanted) == nullptr ? node : nodes_.add(light.name, node);
        shine(light, at,
              of_definition == (light.profile == nullptr) && same_file ? use : Json::object());
    }
    state(light, at, light.profile ? SavedLight::photometric : SavedLight::punctual);
    names_[static_cast<std::uint32_t>(scene_.lights.size() + index) + 1] = {
        {"node", at}, {"photometric", light.profile != nullptr}};
}

void LightWriter::write_added(const PunctualLight& light) {
    const int node = new_node(light, -1);
    shine(light, node, Json::object());
    state(light, node, SavedLight::photometric);
    names_[light.added->number] = {{"node", node}, {"photometric", true}};
}

int LightWriter::place(std::size_t index, int node) {
    const PunctualLight& light = scene_.punctual_lights[index];
    const PunctualLight& before = scene_.source->lights[index];
    if (light.object != PunctualLight::no_object) {
        const int carrier = objects_.new_node(static_cast<std::size_t>(light.object));
        return carrier < 0 ? node : new_node(light, carrier);
    }
    const bool stays = light.position == before.position && light.axes == before.axes;
    return stays ? node : new_node(light, -1);
}

/// parent: that of an object that carries it, or -1.
int LightWriter::new_node(const PunctualLight& light, int parent) {
    const int node = nodes_.add(light.name, parent);
    parent < 0 ? nodes_.set_world(node, matrix_of(light)) : nodes_.set(node, matrix_of(light));
    return node;
}

/// before: how the file has used the definition that the light still has; else empty.
void LightWriter::shine(const PunctualLight& light, int node, const Json& before) {
    Json& extensions = nodes_.at(node)["extensions"];
    if (light.profile) {
        const Json use = photometric_use(light, before);
        extensions[photometric_extension] = use;
    } else {
        const Json use = punctual_use(light, before);
        extensions[punctual_extension] = use;
    }
}

Json LightWriter::photometric_use(const PunctualLight& light, const Json& before) {
    const auto [factor, colour] = factor_and_colour(light);
    parts_.use(photometric_extension);
    const Json* old = find_member(before, "light");
    return {{"light", old == nullptr ? definition(light) : old->get<std::size_t>()},
            {"multiplier", factor},
            {"color", numbers_json(colour)}};
}

Json LightWriter::punctual_use(const PunctualLight& light, const Json& before) {
    const auto [factor, colour] = factor_and_colour(light);
    Json& lights = parts_.json["extensions"][punctual_extension]["lights"];
    const Json* old = find_member(before, "light");
    Json changed = old == nullptr ? Json::object() : lights[old->get<std::size_t>()];
    changed["intensity"] = factor;
    changed["color"] = numbers_json(colour);
    if (light.kind == PunctualKind::spot) {
        changed["type"] = "spot";
        changed["spot"]["innerConeAngle"] = std::acos(double{light.inner_cosine});
        changed["spot"]["outerConeAngle"] = std::acos(double{light.outer_cosine});
    }
    lights.push_back(std::move(changed));
    return {{"light", lights.size() - 1}};
}

/// Index of the entry of the light's photometric file, which is written once.
std::size_t LightWriter::definition(const PunctualLight& light) {
    const std::string file = photometric_file(light);
    if (const auto known = definitions_.find(file); known != definitions_.end()) {
        return known->second;
    }
    const auto bytes = read_file_bounded(file, max_profile_file, scene_.path, "");
    Json& lights = parts_.json["extensions"][photometric_extension]["lights"];
    lights = lights.is_null() ? Json::array() : lights;
    const std::size_t view = parts_.add_view(bytes);
    parts_.json["extensions"][photometric_extension]["lights"].push_back(
        {{"name", file.substr(file.find_last_of('/') + 1)},
         {"bufferView", view},
         {"mimeType", "application/x-ies-lm-63"}});
    return definitions_[file] =
               parts_.json["extensions"][photometric_extension]["lights"].size() - 1;
}

std::string LightWriter::photometric_file(const PunctualLight& light) const {
    if (light.added || light.as_loaded) {
        if (!scene_.folder) {
            throw SceneError(scene_.path, "",
                             "the photometric file '" + light.photometry + "' is gone");
        }
        return (scene_.folder->photometry_folder() / light.photometry).string();
    }
    std::string file;
    for (const std::string& choice : scene_.source->ies) {
        const std::size_t equals = choice.find('=');
        file = choice.substr(0, equals) == light.name ? choice.substr(equals + 1) : file;
    }
    if (file.empty()) {
        throw SceneError(scene_.path, "",
                         "it is not known which photometric file light '" + light.name + "' has");
    }
    return file;
}

void LightWriter::state(const PunctualLight& light, int node, const char* key) {
    const PunctualSetting setting = setting_of(light);
    Json saved = setting_json(setting.intensity, setting.colour, setting.on);
    saved.update(control_json(light.control));
    saved["number"] = ++written_;
    saved["name"] = light.name;
    if (!light.photometry.empty()) {
        saved["photometry"] = light.photometry;
    }
    if (light.kind == PunctualKind::spot) {
        saved["innerCosine"] = light.inner_cosine;
        saved["outerCosine"] = light.outer_cosine;
    }
    saved["position"] = numbers_json(light.position);
    Json& axes = saved["axes"] = Json::array();
    for (int i = 0; i < 9; ++i) {
        axes.push_back(light.axes[i / 3][i % 3]);
    }
    saved_extras(nodes_.at(node))[key] = std::move(saved);
}

}  // namespace raybundle
