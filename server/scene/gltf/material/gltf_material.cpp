// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/material/gltf_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "scene/gltf/file/gltf_image.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/gltf/material/gltf_clear_coat.h"
#include "scene/gltf/material/gltf_max_phong.h"
#include "scene/gltf/material/gltf_transmission.h"
#include "scene/material/alpha_blend.h"

namespace raybundle {
namespace {

const tinygltf::Value* specular_glossiness(const tinygltf::Material& material) {
    return find_extension(material.extensions, "KHR_materials_pbrSpecularGlossiness");
}

/// Base colour of the metallic-roughness model, or the diffuse part of
/// KHR_materials_pbrSpecularGlossiness. Its index is -1 if there is none.
tinygltf::TextureInfo base_colour_info(const tinygltf::Material& material) {
    const tinygltf::Value* extension = specular_glossiness(material);
    if (extension == nullptr) {
        return material.pbrMetallicRoughness.baseColorTexture;
    }
    tinygltf::TextureInfo info;
    if (extension->Has("diffuseTexture")) {
        const tinygltf::Value& diffuse = extension->Get("diffuseTexture");
        info.index = integer_or(diffuse, "index", -1);
        info.texCoord = integer_or(diffuse, "texCoord", 0);
        info.extensions = diffuse.Get("extensions").Get<tinygltf::Value::Object>();
    }
    return info;
}

/// Reflectance of a dielectric at normal incidence; 0 stands for an infinite index.
float ior_reflectance(float ior) {
    const float root = ior == 0.0F ? 1.0F : (ior - 1.0F) / (ior + 1.0F);
    return root * root;
}

/// Textures of a material that is lit like others. An unlit one has only its base colour.
bool is_unlit(const tinygltf::Material& material) {
    return find_extension(material.extensions, "KHR_materials_unlit") != nullptr;
}

/// Index -1 if there is none.
tinygltf::TextureInfo metallic_roughness_info(const tinygltf::Material& material) {
    return specular_glossiness(material) != nullptr
               ? tinygltf::TextureInfo()
               : material.pbrMetallicRoughness.metallicRoughnessTexture;
}

template <typename Info>
int uv_set_of(const Info& info) {
    const auto* transform = find_extension(info.extensions, "KHR_texture_transform");
    return transform == nullptr ? info.texCoord : integer_or(*transform, "texCoord", info.texCoord);
}

/// UV set of the first texture that a material has, in this order; -1 without any.
int first_uv_set(const tinygltf::Material& material) {
    const tinygltf::TextureInfo base = base_colour_info(material);
    if (base.index >= 0 || is_unlit(material)) {
        return base.index >= 0 ? uv_set_of(base) : -1;
    }
    if (material.emissiveTexture.index >= 0) {
        return uv_set_of(material.emissiveTexture);
    }
    const tinygltf::TextureInfo reflectance = metallic_roughness_info(material);
    if (reflectance.index >= 0) {
        return uv_set_of(reflectance);
    }
    return material.normalTexture.index >= 0 ? uv_set_of(material.normalTexture) : -1;
}

/// KHR_texture_transform: scale, then rotate counter-clockwise (v points down), then offset.
template <typename Info>
glm::mat3 uv_transform(const Info& info) {
    const auto* transform = find_extension(info.extensions, "KHR_texture_transform");
    if (transform == nullptr) {
        return glm::mat3(1.0F);
    }
    const glm::vec2 offset = vector_or(*transform, "offset", glm::vec2(0.0F));
    const glm::vec2 scale = vector_or(*transform, "scale", glm::vec2(1.0F));
    const float angle = number_or(*transform, "rotation", 0.0F);
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    // Columns.
    return {scale.x * c, -scale.x * s, 0.0F,     scale.y * s, scale.y * c,
            0.0F,        offset.x,     offset.y, 1.0F};
}

class MaterialReader {
  public:
    MaterialReader(GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}

    void read(std::size_t index) {
        const tinygltf::Material& source = document_.model().materials[index];
        Material material;
        material.name = source.name;
        read_base(source, material);
        read_emission(source, item_path("materials", index), material);
        read_alpha(source, material);
        if (const auto* specular = find_extension(source.extensions, "KHR_materials_specular")) {
            material.specular = number_or(*specular, "specularFactor", 1.0F);
            material.specular_colour = vector_or(*specular, "specularColorFactor", glm::vec3(1.0F));
        }
        read_index_of_refraction(source, material);
        read_transmission(document_, source, material);
        material.max_phong = read_max_phong(source.extras);
        material.double_sided = source.doubleSided;
        material.unlit = is_unlit(source);
        if (material.unlit) {
            material.emission = glm::vec3(0.0F);
            material.dark_emission = glm::vec3(0.0F);
            material.emission_texture = {};
        } else {
            read_details(source, item_path("materials", index), material);
        }
        read_diffuse_transmission(document_, source, material);
        spread_part_transmission(document_, scene_, material);
        read_clear_coat(document_, source, material);
        if (source.alphaMode == "BLEND") {
            if (const auto notice = read_alpha_blend(scene_.textures, material)) {
                document_.note(*notice);
            }
        }
        note_unused(source);
        restore(source, static_cast<int>(index), material);
        scene_.materials.push_back(std::move(material));
    }

  private:
    void restore(const tinygltf::Material& source, int index, Material& material) {
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        restore_surface(document_.saved(), index,
                        glm::vec3(vector_or(pbr.baseColorFactor, glm::vec4(1.0F))),
                        static_cast<float>(pbr.metallicFactor),
                        static_cast<float>(pbr.roughnessFactor), material);
    }

    void read_base(const tinygltf::Material& source, Material& material) {
        glm::vec4 colour(1.0F);
        if (const tinygltf::Value* diffuse = specular_glossiness(source)) {
            // The older model names its Lambert part outright.
            colour = vector_or(*diffuse, "diffuseFactor", colour);
            material.metallic = 0.0F;
            material.roughness = 1.0F - number_or(*diffuse, "glossinessFactor", 1.0F);
            // It states the reflectance at normal incidence.
            material.specular_colour =
                vector_or(*diffuse, "specularFactor", glm::vec3(1.0F)) / ior_reflectance(1.5F);
        } else {
            const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
            colour = vector_or(pbr.baseColorFactor, colour);
            material.metallic = static_cast<float>(pbr.metallicFactor);
            material.roughness = static_cast<float>(pbr.roughnessFactor);
        }
        material.base_colour = glm::vec3(colour);
        material.alpha = colour.a;
        if (const tinygltf::TextureInfo info = base_colour_info(source); info.index >= 0) {
            material.base_colour_texture = slot(info);
        }
    }

    /// KHR_materials_ior, as a factor of the reflectance that specular_colour stands for.
    static void read_index_of_refraction(const tinygltf::Material& source, Material& material) {
        if (const auto* extension = find_extension(source.extensions, "KHR_materials_ior")) {
            const float ior = number_or(*extension, "ior", 1.5F);
            material.ior = ior;
            material.specular_colour *= ior_reflectance(ior) / ior_reflectance(1.5F);
        }
    }

    void read_emission(const tinygltf::Material& source, const std::string& path,
                       Material& material) {
        float strength = 1.0F;
        if (const auto* extension =
                find_extension(source.extensions, "KHR_materials_emissive_strength")) {
            strength = number_or(*extension, "emissiveStrength", 1.0F);
        }
        const glm::vec3 factor = vector_or(source.emissiveFactor, glm::vec3(0.0F));
        material.emission = factor * strength;
        material.dark_emission = strength > 0.0F ? glm::vec3(0.0F) : factor;
        const tinygltf::TextureInfo& info = source.emissiveTexture;
        if (info.index < 0 || factor == glm::vec3(0.0F)) {
            return;
        }
        material.emission_texture = slot(info);
        check_uv_set(source, info, path, "emission texture");
    }

    /// Textures that say how a surface reflects.
    void read_details(const tinygltf::Material& source, const std::string& path,
                      Material& material) {
        const tinygltf::TextureInfo reflectance = metallic_roughness_info(source);
        if (reflectance.index >= 0 && !material.max_phong) {
            material.metallic_roughness_texture = detail_slot(reflectance);
            check_uv_set(source, reflectance, path, "metallic-roughness texture");
        }
        if (source.normalTexture.index >= 0) {
            material.normal_texture = detail_slot(source.normalTexture);
            material.normal_scale = static_cast<float>(source.normalTexture.scale);
            check_uv_set(source, source.normalTexture, path, "normal map");
        }
    }

    /// The slot of a texture that a scene is worth showing without: if it cannot be read, a notice
    /// says so.
    template <typename Info>
    TextureSlot detail_slot(const Info& info) {
        try {
            return slot(info);
        } catch (const SceneError& error) {
            document_.note(fmt::format("a texture of roughness or normals is ignored: {}: {}",
                                       error.json_path(), error.reason()));
            return {};
        }
    }

    /// A vertex has one pair of uv.
    template <typename Info>
    void check_uv_set(const tinygltf::Material& source, const Info& info, const std::string& path,
                      const char* what) {
        if (uv_set_of(info) != first_uv_set(source)) {
            document_.note(
                fmt::format("{}: the {} is read with the uv of the {}", path, what,
                            base_colour_info(source).index >= 0 ? "base colour" : "first texture"));
        }
    }

    void read_alpha(const tinygltf::Material& source, Material& material) {
        material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
        if (source.alphaMode == "MASK") {
            material.alpha_mode = AlphaMode::mask;
        }
    }

    void note_unused(const tinygltf::Material& source) {
        if (source.occlusionTexture.index >= 0) {
            document_.note("occlusion textures are ignored: what they stand for is simulated");
        }
        const auto* specular = find_extension(source.extensions, "KHR_materials_specular");
        if (specular != nullptr &&
            (specular->Has("specularTexture") || specular->Has("specularColorTexture"))) {
            document_.note("textures of KHR_materials_specular are ignored, its factors are used");
        }
    }

    template <typename Info>
    TextureSlot slot(const Info& info) {
        TextureSlot result;
        result.uv_from_mesh_uv = uv_transform(info);
        const int image = image_of(document_, info.index);
        if (image < 0) {
            document_.note(fmt::format("textures[{}] has no image and is ignored", info.index));
        } else {
            result.texture = scene_texture(info.index, image);
        }
        return result;
    }

    /// The scene texture for an image and its wrapping, decoded on first use.
    int scene_texture(int texture, int image) {
        const int index = item(document_.model().textures, texture).sampler;
        const tinygltf::Sampler sampler =
            index < 0 ? tinygltf::Sampler() : item(document_.model().samplers, index);
        if (sampler.wrapS == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ||
            sampler.wrapT == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) {
            document_.note("mirrored texture wrapping is read as plain repetition");
        }
        const bool repeat_u = sampler.wrapS != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        const bool repeat_v = sampler.wrapT != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        const std::tuple key(image, repeat_u, repeat_v);
        if (const auto known = known_.find(key); known != known_.end()) {
            return known->second;
        }
        add_texture(image, repeat_u, repeat_v);
        const auto added = static_cast<int>(scene_.textures.size() - 1);
        known_.emplace(key, added);
        return added;
    }

    void add_texture(int image, bool repeat_u, bool repeat_v) {
        DecodedImage decoded = decode_image(document_, image);
        scene_.textures.push_back({item(document_.model().images, image).name, decoded.width,
                                   decoded.height, repeat_u, repeat_v, std::move(decoded.rgba)});
    }

    GltfDocument& document_;
    Scene& scene_;
    std::map<std::tuple<int, bool, bool>, int> known_;
};

}  // namespace

std::uint32_t read_materials(GltfDocument& document, Scene& scene) {
    check_image_sizes(document);
    MaterialReader reader(document, scene);
    for (std::size_t i = 0; i < document.model().materials.size(); ++i) {
        reader.read(i);
    }
    Material fallback;
    fallback.name = "default";
    scene.materials.push_back(fallback);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

bool material_has_texture(const GltfDocument& document, int material) {
    if (material < 0) {
        return false;
    }
    return first_uv_set(item(document.model().materials, material)) >= 0;
}

int uv_set_of_material(const GltfDocument& document, int material) {
    if (material < 0) {
        return 0;
    }
    return std::max(first_uv_set(item(document.model().materials, material)), 0);
}

}  // namespace raybundle
