// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_material.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <tuple>

#include "scene/gltf_image.h"
#include "scene/gltf_max_phong.h"

namespace raybundle {
namespace {

constexpr std::size_t max_texture_bytes = 2ULL << 30U;
constexpr int wrap_clamp_to_edge = 33071;
constexpr int wrap_mirrored_repeat = 33648;

/// textureInfo of the base colour: metallic-roughness, or the diffuse part of
/// KHR_materials_pbrSpecularGlossiness. nullptr if there is none.
const Json* base_colour_info(const Json& material) {
    if (const Json* extension = find_extension(material, "KHR_materials_pbrSpecularGlossiness")) {
        return find_member(*extension, "diffuseTexture");
    }
    const Json* pbr = find_member(material, "pbrMetallicRoughness");
    return pbr == nullptr ? nullptr : find_member(*pbr, "baseColorTexture");
}

int uv_set_of(const Json& texture_info) {
    const int set = value_or(texture_info, "texCoord", 0);
    const Json* transform = find_extension(texture_info, "KHR_texture_transform");
    return transform == nullptr ? set : value_or(*transform, "texCoord", set);
}

/// KHR_texture_transform: scale, then rotate counter-clockwise (v points down), then offset.
glm::mat3 uv_transform(const Json& texture_info) {
    const Json* json = find_extension(texture_info, "KHR_texture_transform");
    if (json == nullptr) {
        return glm::mat3(1.0F);
    }
    const glm::vec2 offset = vector_or(*json, "offset", glm::vec2(0.0F));
    const glm::vec2 scale = vector_or(*json, "scale", glm::vec2(1.0F));
    const auto angle = value_or(*json, "rotation", 0.0F);
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    // Columns.
    return {scale.x * c, -scale.x * s, 0.0F,     scale.y * s, scale.y * c,
            0.0F,        offset.x,     offset.y, 1.0F};
}

/// Index of the image to decode for a texture, -1 if it has none. Throws for KTX2 without fallback.
int image_of(const GltfDocument& document, int texture) {
    const Json& json = document.item("textures", texture);
    const std::string path = item_path("textures", static_cast<std::size_t>(texture));
    const Json* webp = find_extension(json, "EXT_texture_webp");
    int source = webp == nullptr ? -1 : index_or_none(*webp, "source");
    source = source >= 0 ? source : index_or_none(json, "source");
    const std::size_t image_count = document.array("images").size();
    if (source >= 0 && static_cast<std::size_t>(source) >= image_count) {
        document.fail(path + ".source", fmt::format("{} is out of range: the file has {} images",
                                                    source, image_count));
    }
    if (source < 0 && find_extension(json, "KHR_texture_basisu") != nullptr) {
        document.fail(path + ".extensions.KHR_texture_basisu",
                      "KTX2 images (KHR_texture_basisu) are not supported, and there is no "
                      "fallback image");
    }
    return source;
}

class MaterialReader {
  public:
    MaterialReader(GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}

    void read(std::size_t index) {
        const Json& json = document_.array("materials")[index];
        Material material;
        material.name = value_or<std::string>(json, "name", "");
        read_base(json, material);
        read_emission(json, item_path("materials", index), material);
        read_alpha(json, material);
        if (const Json* specular = find_extension(json, "KHR_materials_specular")) {
            material.specular = value_or(*specular, "specularFactor", 1.0F);
            material.specular_colour = vector_or(*specular, "specularColorFactor", glm::vec3(1.0F));
        }
        material.max_phong = read_max_phong(document_, json, item_path("materials", index));
        material.double_sided = value_or(json, "doubleSided", false);
        note_unused(json);
        scene_.materials.push_back(std::move(material));
    }

  private:
    void read_base(const Json& json, Material& material) {
        glm::vec4 colour(1.0F);
        if (const Json* diffuse = find_extension(json, "KHR_materials_pbrSpecularGlossiness")) {
            // The older model names its Lambert part outright.
            colour = vector_or(*diffuse, "diffuseFactor", colour);
            material.metallic = 0.0F;
            material.roughness = 1.0F - value_or(*diffuse, "glossinessFactor", 1.0F);
        } else if (const Json* pbr = find_member(json, "pbrMetallicRoughness")) {
            colour = vector_or(*pbr, "baseColorFactor", colour);
            material.metallic = value_or(*pbr, "metallicFactor", 1.0F);
            material.roughness = value_or(*pbr, "roughnessFactor", 1.0F);
        }
        material.base_colour = glm::vec3(colour);
        material.alpha = colour.a;
        if (const Json* info = base_colour_info(json)) {
            material.base_colour_texture = slot(*info);
        }
    }

    void read_emission(const Json& json, const std::string& path, Material& material) {
        float strength = 1.0F;
        if (const Json* extension = find_extension(json, "KHR_materials_emissive_strength")) {
            strength = value_or(*extension, "emissiveStrength", 1.0F);
        }
        material.emission = vector_or(json, "emissiveFactor", glm::vec3(0.0F)) * strength;
        const Json* info = find_member(json, "emissiveTexture");
        if (info == nullptr || material.emission == glm::vec3(0.0F)) {
            return;
        }
        material.emission_texture = slot(*info);
        const Json* base = base_colour_info(json);
        if (base != nullptr && uv_set_of(*base) != uv_set_of(*info)) {
            document_.note(fmt::format(
                "{}: the emission texture is read with the uv of the base colour", path));
        }
    }

    void read_alpha(const Json& json, Material& material) {
        const auto mode = value_or<std::string>(json, "alphaMode", "OPAQUE");
        material.alpha_cutoff = value_or(json, "alphaCutoff", 0.5F);
        if (mode == "MASK") {
            material.alpha_mode = AlphaMode::mask;
        } else if (mode == "BLEND") {
            material.alpha_mode = AlphaMode::blend;
            document_.note("blended (alpha BLEND) materials are treated as opaque");
        }
    }

    void note_unused(const Json& json) {
        const Json* pbr = find_member(json, "pbrMetallicRoughness");
        if (json.contains("normalTexture") || json.contains("occlusionTexture") ||
            (pbr != nullptr && pbr->contains("metallicRoughnessTexture"))) {
            document_.note("normal, occlusion and metallic-roughness textures are ignored");
        }
    }

    TextureSlot slot(const Json& info) {
        const int texture = info.at("index").get<int>();
        TextureSlot result;
        result.uv_from_mesh_uv = uv_transform(info);
        const int image = image_of(document_, texture);
        if (image < 0) {
            document_.note(fmt::format("textures[{}] has no image and is ignored", texture));
        } else {
            result.texture = scene_texture(texture, image);
        }
        return result;
    }

    /// The scene texture for an image and its wrapping, decoded on first use.
    int scene_texture(int texture, int image) {
        const int sampler = index_or_none(document_.item("textures", texture), "sampler");
        const Json none = Json::object();
        const Json& wrap = sampler < 0 ? none : document_.item("samplers", sampler);
        const int wrap_u = value_or(wrap, "wrapS", 0);
        const int wrap_v = value_or(wrap, "wrapT", 0);
        if (wrap_u == wrap_mirrored_repeat || wrap_v == wrap_mirrored_repeat) {
            document_.note("mirrored texture wrapping is read as plain repetition");
        }
        const bool repeat_u = wrap_u != wrap_clamp_to_edge;
        const bool repeat_v = wrap_v != wrap_clamp_to_edge;
        const auto [it, inserted] = known_.try_emplace(std::tuple(image, repeat_u, repeat_v),
                                                       static_cast<int>(scene_.textures.size()));
        if (inserted) {
            add_texture(image, repeat_u, repeat_v);
        }
        return it->second;
    }

    void add_texture(int image, bool repeat_u, bool repeat_v) {
        const std::string path = item_path("images", static_cast<std::size_t>(image));
        DecodedImage decoded = decode_image(document_, image);
        texture_bytes_ += decoded.rgba.size();
        if (texture_bytes_ > max_texture_bytes) {
            document_.fail(path, fmt::format("decoded images exceed {} bytes", max_texture_bytes));
        }
        const Json& json = document_.item("images", image);
        scene_.textures.push_back({value_or(json, "name", path), decoded.width, decoded.height,
                                   repeat_u, repeat_v, std::move(decoded.rgba)});
    }

    GltfDocument& document_;
    Scene& scene_;
    std::map<std::tuple<int, bool, bool>, int> known_;
    std::size_t texture_bytes_ = 0;
};

}  // namespace

std::uint32_t read_materials(GltfDocument& document, Scene& scene) {
    check_images(document);
    MaterialReader reader(document, scene);
    for (std::size_t i = 0; i < document.array("materials").size(); ++i) {
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
    const Json& json = document.item("materials", material);
    return base_colour_info(json) != nullptr || json.contains("emissiveTexture");
}

int uv_set_of_material(const GltfDocument& document, int material) {
    if (material < 0) {
        return 0;
    }
    const Json& json = document.item("materials", material);
    if (const Json* base = base_colour_info(json)) {
        return uv_set_of(*base);
    }
    const Json* emission = find_member(json, "emissiveTexture");
    return emission == nullptr ? 0 : uv_set_of(*emission);
}

}  // namespace raybundle
