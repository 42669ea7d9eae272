// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

constexpr std::array<std::string_view, 18> fully_read = {
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_materials_emissive_strength",
    "KHR_materials_specular",
    "KHR_draco_mesh_compression",
    "KHR_node_visibility",
    "EXT_meshopt_compression",
    "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",
    "KHR_xmp_json_ld",
    "KHR_lights_punctual",
    "EXT_lights_ies",
    "KHR_materials_ior",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_materials_clearcoat",
    "KHR_animation_pointer",
};

struct Approximation {
    std::string_view extension, notice;
};

// The geometry of a file that requires one of these is right, only its look is simplified.
constexpr std::array<Approximation, 4> approximated = {{
    {"KHR_materials_unlit", "unlit materials are shown as they are, and are black to light"},
    {"KHR_materials_variants", "the default material variants are used"},
    {"KHR_materials_pbrSpecularGlossiness",
     "colours and glossiness are used, the specular-glossiness texture is ignored"},
    {"KHR_texture_basisu",
     "KTX2 images cannot be decoded: the fallback images of the textures are used"},
}};

bool is_fully_read(const std::string& name) {
    return std::find(fully_read.begin(), fully_read.end(), name) != fully_read.end();
}

const Approximation* find_approximation(const std::string& name) {
    const auto* it = std::find_if(approximated.begin(), approximated.end(),
                                  [&](const Approximation& a) { return a.extension == name; });
    return it == approximated.end() ? nullptr : it;
}

bool can_be_required(const std::string& name) {
    return is_fully_read(name) ||
           (find_approximation(name) != nullptr && name != "KHR_texture_basisu");
}

}  // namespace

void check_required_extensions(const std::string& file, const Json& json) {
    const Json& required = array_or_empty(json, "extensionsRequired");
    for (std::size_t i = 0; i < required.size(); ++i) {
        const auto name = required[i].get<std::string>();
        if (!can_be_required(name)) {
            throw SceneError(file, item_path("extensionsRequired", i),
                             fmt::format("extension {} is required but not supported", name));
        }
    }
}

void note_ignored_extensions(const Json& json, GltfDocument& document) {
    for (const Json& used : array_or_empty(json, "extensionsUsed")) {
        const auto name = used.get<std::string>();
        if (is_fully_read(name)) {
            continue;
        }
        if (const Approximation* approximation = find_approximation(name)) {
            document.note(fmt::format("{}: {}", name, approximation->notice));
        } else {
            document.note(fmt::format("extension {} is ignored", name));
        }
    }
}

}  // namespace raybundle
