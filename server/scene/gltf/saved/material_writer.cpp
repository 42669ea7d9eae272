// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/material_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "scene/gltf/file/gltf_confinement.h"
#include "scene/gltf/file/gltf_schema.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/gltf/saved/saved_state.h"
#include "scene/mesh/mesh_growth.h"
#include "scene/scene_folder.h"

namespace raybundle {
namespace {

constexpr const char* strength = "KHR_materials_emissive_strength";
constexpr const char* glossiness = "KHR_materials_pbrSpecularGlossiness";

glm::vec3 colour_or(const Json& json, const char* key, const glm::vec3& fallback) {
    const Json* found = find_member(json, key);
    return found == nullptr ? fallback
                            : glm::vec3((*found)[0].get<float>(), (*found)[1].get<float>(),
                                        (*found)[2].get<float>());
}

/// The colour that makes the loader's one, which may be part of what glTF names.
glm::vec3 base_for(const glm::vec3& wanted, const glm::vec3& loaded, const glm::vec3& before) {
    glm::vec3 base = wanted;
    for (int c = 0; c < 3; ++c) {
        if (loaded[c] != before[c] && loaded[c] > 0.0F) {
            base[c] = before[c] * wanted[c] / loaded[c];
        }
    }
    return glm::clamp(base, 0.0F, 1.0F);
}

Json with_alpha(const glm::vec3& colour, const Json& json, const char* key) {
    const Json* found = find_member(json, key);
    const Json alpha = found == nullptr ? Json(1.0) : (*found)[3];
    return {colour.r, colour.g, colour.b, alpha};
}

void write_surface(const Material& now, const Material& loaded, Json& json) {
    Json& pbr = json["pbrMetallicRoughness"];
    pbr = pbr.is_null() ? Json::object() : pbr;
    const glm::vec3 before = colour_or(pbr, "baseColorFactor", glm::vec3(1.0F));
    const glm::vec3 base = now.base_colour == loaded.base_colour
                               ? before
                               : base_for(now.base_colour, loaded.base_colour, before);
    pbr["baseColorFactor"] = with_alpha(base, pbr, "baseColorFactor");
    pbr["metallicFactor"] = now.metallic;
    pbr["roughnessFactor"] = now.roughness;
    const Json::json_pointer older("/extensions/KHR_materials_pbrSpecularGlossiness");
    if (json.contains(older)) {
        Json& diffuse = json[older];
        diffuse["diffuseFactor"] = with_alpha(now.base_colour, diffuse, "diffuseFactor");
        diffuse["glossinessFactor"] = 1.0F - now.roughness;
    }
    saved_extras(json)["surface"] = {{"baseColour", numbers_json(now.base_colour)},
                                     {"metallic", now.metallic},
                                     {"roughness", now.roughness},
                                     {"of",
                                      {{"baseColour", numbers_json(base)},
                                       {"metallic", now.metallic},
                                       {"roughness", now.roughness}}}};
}

void write_emission(const glm::vec3& emission, Json& json, GlbParts& parts) {
    const float most = std::max({emission.r, emission.g, emission.b});
    if (most > 0.0F) {
        json["emissiveFactor"] = numbers_json(emission / most);
    }
    json["extensions"][strength]["emissiveStrength"] = most;
    parts.use(strength);
}

void write_changes(std::span<const Material> now, std::span<const Material> loaded,
                   std::size_t first, GlbParts& parts) {
    for (std::size_t i = 0; i < loaded.size(); ++i) {
        Json& json = parts.json["materials"][first + i];
        const bool same = now[i].base_colour == loaded[i].base_colour &&
                          now[i].metallic == loaded[i].metallic &&
                          now[i].roughness == loaded[i].roughness;
        if (!same) {
            write_surface(now[i], loaded[i], json);
        }
        if (now[i].emission != loaded[i].emission) {
            write_emission(now[i].emission, json, parts);
        }
    }
}

/// Triangles without a material have glTF's default one, which the scene keeps as its last.
void name_default(std::size_t count, GlbParts& parts) {
    Json& materials = parts.json["materials"];
    materials = materials.is_null() ? Json::array() : materials;
    if (materials.size() >= count) {
        return;
    }
    materials.push_back({{"name", "default"}});
    const std::size_t index = materials.size() - 1;
    const auto meshes = parts.json.find("meshes");
    for (std::size_t m = 0; meshes != parts.json.end() && m < meshes->size(); ++m) {
        for (Json& primitive : (*meshes)[m]["primitives"]) {
            primitive.emplace("material", index);
        }
    }
}

/// Moves the items of one file behind those of another one.
class Appender {
  public:
    Appender(const GlbParts& from, GlbParts& to) : from_(from), to_(to) {
        for (const char* array : {"images", "samplers", "textures"}) {
            first_[array] = array_or_empty(to.json, array).size();
        }
    }

    void append() {
        for (Json image : array_or_empty(from_.json, "images")) {
            if (const Json* view = find_member(image, "bufferView")) {
                image["bufferView"] = to_.add_view(bytes_of(view->get<std::size_t>()));
            }
            to_.add("images", std::move(image));
        }
        for (const Json& sampler : array_or_empty(from_.json, "samplers")) {
            to_.add("samplers", sampler);
        }
        for (Json texture : array_or_empty(from_.json, "textures")) {
            shift(texture, "source", "images");
            shift(texture, "sampler", "samplers");
            if (const auto extensions = texture.find("extensions"); extensions != texture.end()) {
                for (Json& extension : *extensions) {
                    shift(extension, "source", "images");
                }
            }
            to_.add("textures", std::move(texture));
        }
        for (Json material : array_or_empty(from_.json, "materials")) {
            shift_textures(material, 0);
            drop_saved(material, "light");
            to_.add("materials", std::move(material));
        }
        append_names("extensionsUsed");
        append_names("extensionsRequired");
    }

  private:
    [[nodiscard]] std::span<const std::uint8_t> bytes_of(std::size_t index) const {
        const Json& view = from_.json.at("bufferViews").at(index);
        const std::size_t offset = value_or<std::size_t>(view, "byteOffset", 0);
        const std::size_t length = value_or<std::size_t>(view, "byteLength", 0);
        if (value_or<std::size_t>(view, "buffer", 0) != 0 || offset > from_.binary.size() ||
            length > from_.binary.size() - offset) {
            throw SceneError(from_.path, fmt::format("bufferViews[{}]", index),
                             "the bytes of an image are not there");
        }
        return std::span(from_.binary).subspan(offset, length);
    }

    void shift(Json& item, const char* key, const char* array) const {
        const auto found = item.is_object() ? item.find(key) : item.end();
        if (item.is_object() && found != item.end() && found->is_number_unsigned()) {
            *found = found->get<std::size_t>() + first_.at(array);
        }
    }

    /// Members such as "baseColorTexture", of the material and its extensions.
    void shift_textures(Json& item, int depth) const {
        constexpr int most = 8;
        constexpr std::string_view suffix = "exture";
        if (!item.is_object() || depth > most) {
            return;
        }
        for (auto& [key, value] : item.items()) {
            if (key == "extras") {
                continue;
            }
            if (key.ends_with(suffix)) {
                shift(value, "index", "textures");
            }
            shift_textures(value, depth + 1);
        }
    }

    /// Extensions of what is taken over.
    void append_names(const char* array) {
        for (const Json& name : array_or_empty(from_.json, array)) {
            const auto text = name.get<std::string>();
            const bool taken = text.starts_with("KHR_materials_") ||
                               text.starts_with("KHR_texture_") || text.starts_with("EXT_texture_");
            Json& names = to_.json[array];
            names = names.is_null() ? Json::array() : names;
            if (taken && std::find(names.begin(), names.end(), name) == names.end()) {
                names.push_back(name);
            }
            if (names.empty()) {
                to_.json.erase(array);
            }
        }
    }

    const GlbParts& from_;
    GlbParts& to_;
    std::map<std::string, std::size_t> first_;
};

/// Of a file whose objects have been added.
void append_materials(const SceneToSave& scene, const AddedObject& added, std::size_t first,
                      GlbParts& parts) {
    if (!scene.folder) {
        throw SceneError(scene.path, "", "the folder of '" + added.library + "' is gone");
    }
    const std::string path = scene.folder->scene_file(added.library);
    check_confined(path);
    GltfContainer container = read_gltf_container(path);
    check_schema(path, container.json);  // it may be another one by now
    GlbParts file = embed(path, std::move(container));
    name_default(added.materials.size(), file);
    if (file.json["materials"].size() != added.materials.size()) {
        throw SceneError(path, "materials", "the file has changed since it was added to a scene");
    }
    Appender(file, parts).append();
    write_changes(std::span(scene.materials).subspan(first, added.materials.size()),
                  added.materials, first, parts);
}

}  // namespace

void write_materials(const SceneToSave& scene, GlbParts& parts) {
    std::size_t first = scene.source->materials.size();
    name_default(first, parts);
    write_changes(std::span(scene.materials).first(first), scene.source->materials, 0, parts);
    for (const Object& object : scene.objects) {
        if (object.added && object.added->copy_of == 0) {
            append_materials(scene, *object.added, first, parts);
            first += object.added->materials.size();
        }
    }
    for (Json& material : parts.json["materials"]) {
        drop_saved(material, "light");
    }
    for (const Light& light : scene.lights) {
        Json& material = parts.json["materials"][static_cast<std::size_t>(light.material)];
        Json saved = setting_json(light.radiance, light.colour, light.on);
        saved.update(control_json(light.control));
        saved_extras(material)["light"] = std::move(saved);
    }
    if (parts.json["materials"].empty()) {
        parts.json.erase("materials");
    }
}

}  // namespace raybundle
