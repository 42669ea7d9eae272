// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_schema.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

enum class Kind { object, text, flag, integer, number, numbers, index, choice };

/// What holds at one path. "[]" steps into every element of an array, "*" into every member.
struct Rule {
    std::string_view path;
    Kind kind = Kind::object;
    bool required = false;
    double min = 0.0;
    double max = 0.0;
    std::size_t length = 0;      // of Kind::numbers
    std::uint64_t multiple = 1;  // Kind::integer: what it has to be a multiple of
    std::string_view options{};  // Kind::index: the array it refers to; Kind::choice: "A|B|C"
};

constexpr double huge = 3.0e38;      // the largest float, roughly
constexpr double max_bytes = 4.3e9;  // far above what is ever allocated
// tinygltf keeps the integers of sparse accessors and extensions in 32 bits.
constexpr double max_int = 2147483647.0;
constexpr double right_angle = 1.5708;  // rad, rounded up
constexpr bool required = true;

constexpr Rule object(std::string_view path, bool is_required = false) {
    return {path, Kind::object, is_required};
}
constexpr Rule text(std::string_view path, bool is_required = false) {
    return {path, Kind::text, is_required};
}
constexpr Rule flag(std::string_view path) {
    return {path, Kind::flag};
}
constexpr Rule integer(std::string_view path, double min, double max, bool is_required = false,
                       std::uint64_t multiple = 1) {
    return {path, Kind::integer, is_required, min, max, 0, multiple};
}
constexpr Rule number(std::string_view path, double min, double max, bool is_required = false) {
    return {path, Kind::number, is_required, min, max};
}
constexpr Rule numbers(std::string_view path, std::size_t length, double min = -huge,
                       double max = huge) {
    return {path, Kind::numbers, false, min, max, length};
}
constexpr Rule index(std::string_view path, std::string_view array, bool is_required = false) {
    return {path, Kind::index, is_required, 0.0, 0.0, 0, 1, array};
}
constexpr Rule choice(std::string_view path, std::string_view options, bool is_required = false) {
    return {path, Kind::choice, is_required, 0.0, 0.0, 0, 1, options};
}

constexpr std::string_view specular_glossiness_extension =
    "materials[].extensions.KHR_materials_pbrSpecularGlossiness";
constexpr std::string_view accessor_types = "SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4";

/// Checked first: what else another version has otherwise is a symptom.
constexpr Rule asset_rules[] = {
    object("asset", required),
    text("asset.version", required),
    text("asset.minVersion"),
};

constexpr Rule rules[] = {
    text("extensionsUsed[]"),
    text("extensionsRequired[]"),

    integer("buffers[].byteLength", 1, max_bytes, required),
    text("buffers[].uri"),
    flag("buffers[].extensions.EXT_meshopt_compression.fallback"),
    index("bufferViews[].buffer", "buffers", required),
    integer("bufferViews[].byteOffset", 0, max_bytes),
    integer("bufferViews[].byteLength", 1, max_bytes, required),
    integer("bufferViews[].byteStride", 4, 252, !required, 4),
    index("bufferViews[].extensions.EXT_meshopt_compression.buffer", "buffers", required),
    integer("bufferViews[].extensions.EXT_meshopt_compression.byteOffset", 0, max_int),
    integer("bufferViews[].extensions.EXT_meshopt_compression.byteLength", 1, max_int, required),
    integer("bufferViews[].extensions.EXT_meshopt_compression.byteStride", 1, 256, required),
    integer("bufferViews[].extensions.EXT_meshopt_compression.count", 1, max_int, required),
    choice("bufferViews[].extensions.EXT_meshopt_compression.mode", "ATTRIBUTES|TRIANGLES|INDICES",
           required),
    choice("bufferViews[].extensions.EXT_meshopt_compression.filter",
           "NONE|OCTAHEDRAL|QUATERNION|EXPONENTIAL"),

    index("accessors[].bufferView", "bufferViews"),
    integer("accessors[].byteOffset", 0, max_bytes),
    integer("accessors[].componentType", 5120, 5126, required),
    integer("accessors[].count", 1, max_bytes, required),
    choice("accessors[].type", accessor_types, required),
    flag("accessors[].normalized"),
    integer("accessors[].sparse.count", 1, max_int, required),
    object("accessors[].sparse.indices", required),
    index("accessors[].sparse.indices.bufferView", "bufferViews", required),
    integer("accessors[].sparse.indices.byteOffset", 0, max_int),
    integer("accessors[].sparse.indices.componentType", 5121, 5125, required),
    object("accessors[].sparse.values", required),
    index("accessors[].sparse.values.bufferView", "bufferViews", required),
    integer("accessors[].sparse.values.byteOffset", 0, max_int),

    text("images[].uri"),
    text("images[].name"),
    text("images[].mimeType"),
    index("images[].bufferView", "bufferViews"),
    integer("samplers[].wrapS", 0, 65535),
    integer("samplers[].wrapT", 0, 65535),
    // Whether these exist matters only for the textures that are used: see image_of().
    integer("textures[].source", 0, 1e9),
    index("textures[].sampler", "samplers"),
    integer("textures[].extensions.EXT_texture_webp.source", 0, 1e9),
    object("textures[].extensions.KHR_texture_basisu"),

    object("materials[]"),
    text("materials[].name"),
    object("materials[].pbrMetallicRoughness"),
    numbers("materials[].pbrMetallicRoughness.baseColorFactor", 4, 0, huge),
    number("materials[].pbrMetallicRoughness.metallicFactor", 0, 1),
    number("materials[].pbrMetallicRoughness.roughnessFactor", 0, 1),
    numbers("materials[].emissiveFactor", 3, 0, 1e9),
    number("materials[].extensions.KHR_materials_diffuse_transmission.diffuseTransmissionFactor", 0,
           1),
    numbers(
        "materials[].extensions.KHR_materials_diffuse_transmission.diffuseTransmissionColorFactor",
        3, 0, huge),
    number("materials[].normalTexture.scale", -1e6, 1e6),
    choice("materials[].alphaMode", "OPAQUE|MASK|BLEND"),
    number("materials[].alphaCutoff", 0, huge),
    flag("materials[].doubleSided"),
    number("materials[].extensions.KHR_materials_emissive_strength.emissiveStrength", 0, 1e12),
    number("materials[].extensions.KHR_materials_specular.specularFactor", 0, 1),
    numbers("materials[].extensions.KHR_materials_specular.specularColorFactor", 3, 0, huge),
    object(specular_glossiness_extension),
    numbers("materials[].extensions.KHR_materials_pbrSpecularGlossiness.diffuseFactor", 4, 0, huge),
    number("materials[].extensions.KHR_materials_pbrSpecularGlossiness.glossinessFactor", 0, 1),
    numbers("materials[].extensions.KHR_materials_pbrSpecularGlossiness.specularFactor", 3, 0, 1),
    number("materials[].extensions.KHR_materials_ior.ior", 0, 1e6),

    object("meshes[]"),
    text("meshes[].name"),
    number("meshes[].weights[]", -1e6, 1e6),
    object("meshes[].primitives[]"),
    object("meshes[].primitives[].attributes", required),
    index("meshes[].primitives[].attributes.*", "accessors"),
    index("meshes[].primitives[].indices", "accessors"),
    index("meshes[].primitives[].material", "materials"),
    integer("meshes[].primitives[].mode", 0, 6),
    index("meshes[].primitives[].targets[].*", "accessors"),
    index("meshes[].primitives[].extensions.KHR_draco_mesh_compression.bufferView", "bufferViews",
          required),
    integer("meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes.*", 0, 4.2e9),

    index("skins[].joints[]", "nodes"),
    index("skins[].inverseBindMatrices", "accessors"),
    choice("cameras[].type", "perspective|orthographic", required),
    text("cameras[].name"),
    number("cameras[].perspective.yfov", -huge, huge),

    object("nodes[]"),
    text("nodes[].name"),
    index("nodes[].children[]", "nodes"),
    index("nodes[].mesh", "meshes"),
    index("nodes[].camera", "cameras"),
    index("nodes[].skin", "skins"),
    numbers("nodes[].matrix", 16, -1e15, 1e15),
    numbers("nodes[].translation", 3, -1e15, 1e15),
    numbers("nodes[].rotation", 4, -1e6, 1e6),
    numbers("nodes[].scale", 3, -1e15, 1e15),
    number("nodes[].weights[]", -1e6, 1e6),
    index("nodes[].extensions.EXT_mesh_gpu_instancing.attributes.*", "accessors"),
    flag("nodes[].extensions.KHR_node_visibility.visible"),

    integer("nodes[].extensions.KHR_lights_punctual.light", 0, 1e9, required),
    object("extensions"),
    object("extensions.KHR_lights_punctual.lights[]"),
    text("extensions.KHR_lights_punctual.lights[].name"),
    choice("extensions.KHR_lights_punctual.lights[].type", "point|spot|directional", required),
    numbers("extensions.KHR_lights_punctual.lights[].color", 3, 0, 1e9),
    number("extensions.KHR_lights_punctual.lights[].intensity", 0, 1e12),
    number("extensions.KHR_lights_punctual.lights[].range", 0, 1e308),  // FLT_MAX, too
    number("extensions.KHR_lights_punctual.lights[].spot.innerConeAngle", 0, right_angle),
    number("extensions.KHR_lights_punctual.lights[].spot.outerConeAngle", 0, right_angle),

    integer("nodes[].extensions.EXT_lights_ies.light", 0, 1e9, required),
    number("nodes[].extensions.EXT_lights_ies.multiplier", 0, 1e12),
    numbers("nodes[].extensions.EXT_lights_ies.color", 3, 0, 1e9),
    object("extensions.EXT_lights_ies.lights[]"),
    text("extensions.EXT_lights_ies.lights[].name"),
    text("extensions.EXT_lights_ies.lights[].uri"),
    index("extensions.EXT_lights_ies.lights[].bufferView", "bufferViews"),

    text("scenes[].name"),
    index("scenes[].nodes[]", "nodes"),
    index("scene", "scenes"),
};

/// Where a textureInfo can stand that the loader reads.
constexpr std::string_view texture_infos[] = {
    "materials[].pbrMetallicRoughness.baseColorTexture",
    "materials[].emissiveTexture",
    "materials[].normalTexture",
    "materials[].pbrMetallicRoughness.metallicRoughnessTexture",
    "materials[].extensions.KHR_materials_pbrSpecularGlossiness.diffuseTexture",
};

std::vector<std::string_view> steps_of(std::string_view path) {
    std::vector<std::string_view> steps;
    while (!path.empty()) {
        const std::size_t end = path.front() == '[' ? 2 : path.find_first_of(".[");
        const std::size_t length = std::min(end, path.size());
        steps.push_back(path.substr(0, length));
        path.remove_prefix(length);
        if (!path.empty() && path.front() == '.') {
            path.remove_prefix(1);
        }
    }
    return steps;
}

class Checker {
  public:
    Checker(const std::string& file, Json& json) : file_(file), json_(json) {}

    void check(const Rule& rule) {
        rule_ = &rule;
        steps_ = steps_of(rule.path);
        visit(json_, 0, "");
    }

  private:
    [[noreturn]] void fail(const std::string& path, const std::string& reason) const {
        throw SceneError(file_, path, reason);
    }

    void visit(Json& value, std::size_t step, const std::string& path) const {
        if (step == steps_.size()) {
            check_value(value, path);
        } else if (steps_[step] == "[]") {
            visit_elements(value, step, path);
        } else {
            visit_members(value, step, path);
        }
    }

    void visit_elements(Json& value, std::size_t step, const std::string& path) const {
        if (!value.is_array()) {
            fail(path, "must be an array");
        }
        for (std::size_t i = 0; i < value.size(); ++i) {
            visit(value[i], step + 1, fmt::format("{}[{}]", path, i));
        }
    }

    void visit_members(Json& value, std::size_t step, const std::string& path) const {
        if (!value.is_object()) {
            fail(path, "must be an object");
        }
        const std::string prefix = path.empty() ? path : path + ".";
        if (steps_[step] == "*") {
            for (auto it = value.begin(); it != value.end(); ++it) {
                visit(*it, step + 1, prefix + it.key());
            }
            return;
        }
        const std::string key(steps_[step]);
        const auto found = value.find(key);
        if (found != value.end()) {
            visit(*found, step + 1, prefix + key);
        } else if (rule_->required && step + 1 == steps_.size()) {
            fail(prefix + key, "is missing");
        }
    }

    void check_value(Json& value, const std::string& path) const {
        switch (rule_->kind) {
            case Kind::object:
                require(value.is_object(), path, "must be an object");
                break;
            case Kind::text:
                require(value.is_string(), path, "must be a string");
                break;
            case Kind::flag:
                require(value.is_boolean(), path, "must be true or false");
                break;
            case Kind::integer:
                check_integer(value, path);
                break;
            case Kind::number:
                check_number(value, path);
                break;
            case Kind::numbers:
                check_numbers(value, path);
                break;
            case Kind::index:
                check_index(value, path);
                break;
            case Kind::choice:
                check_choice(value, path);
                break;
        }
    }

    void require(bool holds, const std::string& path, const char* reason) const {
        if (!holds) {
            fail(path, reason);
        }
    }

    // JSON knows no integers: 1.0 is as good as 1.
    static bool is_integer(const Json& value) {
        return value.is_number_integer() ||
               (value.is_number() && std::floor(value.get<double>()) == value.get<double>());
    }

    void check_integer(Json& value, const std::string& path) const {
        require(is_integer(value), path, "must be an integer");
        check_number(value, path);
        const auto integer = static_cast<std::uint64_t>(value.get<double>());
        if (integer % rule_->multiple != 0) {
            fail(path, fmt::format("must be a multiple of {}", rule_->multiple));
        }
        value = integer;
    }

    void check_number(Json& value, const std::string& path) const {
        require(value.is_number(), path, "must be a number");
        const auto x = value.get<double>();
        if (!(x >= rule_->min && x <= rule_->max)) {
            fail(path, fmt::format("{} is not in [{}, {}]", x, rule_->min, rule_->max));
        }
        value = x;
    }

    void check_numbers(Json& value, const std::string& path) const {
        if (!value.is_array() || value.size() != rule_->length) {
            fail(path, fmt::format("must be an array of {} numbers", rule_->length));
        }
        for (std::size_t i = 0; i < value.size(); ++i) {
            check_number(value[i], fmt::format("{}[{}]", path, i));
        }
    }

    void check_index(Json& value, const std::string& path) const {
        const Json& array = array_or_empty(json_, std::string(rule_->options).c_str());
        require(is_integer(value), path, "must be an index");
        const auto x = value.get<double>();
        if (x < 0.0 || x >= static_cast<double>(array.is_array() ? array.size() : 0)) {
            fail(path, fmt::format("{} is out of range: the file has {} {}", x,
                                   array.is_array() ? array.size() : 0, rule_->options));
        }
        value = static_cast<std::uint64_t>(x);
    }

    void check_choice(const Json& value, const std::string& path) const {
        require(value.is_string(), path, "must be a string");
        const std::string wanted = fmt::format("|{}|", value.get<std::string>());
        if (fmt::format("|{}|", rule_->options).find(wanted) == std::string::npos) {
            fail(path,
                 fmt::format("\"{}\" is not one of {}", value.get<std::string>(), rule_->options));
        }
    }

    const std::string& file_;
    Json& json_;
    const Rule* rule_ = nullptr;
    std::vector<std::string_view> steps_;
};

void check_version(const std::string& file, const Json& asset) {
    for (const char* key : {"version", "minVersion"}) {
        const std::string version = value_or<std::string>(asset, key, "2.0");
        const bool newer = std::string_view(key) == "minVersion" && version != "2.0";
        if (!version.starts_with("2.") || version.size() < 3 || newer) {
            throw SceneError(file, fmt::format("asset.{}", key),
                             fmt::format("glTF version \"{}\", only 2.0 is supported", version));
        }
    }
}

}  // namespace

void check_schema(const std::string& file, Json& json) {
    Checker checker(file, json);
    for (const Rule& rule : asset_rules) {
        checker.check(rule);
    }
    check_version(file, json.at("asset"));
    for (const Rule& rule : rules) {
        checker.check(rule);
    }
    for (const std::string_view info : texture_infos) {
        const std::string path(info);
        const std::string transform = path + ".extensions.KHR_texture_transform";
        const std::string index_path = path + ".index";
        checker.check(index(index_path, "textures", required));
        const std::string members[] = {path + ".texCoord", transform + ".offset",
                                       transform + ".scale", transform + ".rotation",
                                       transform + ".texCoord"};
        checker.check(integer(members[0], 0, 255));
        checker.check(numbers(members[1], 2));
        checker.check(numbers(members[2], 2));
        checker.check(number(members[3], -huge, huge));
        checker.check(integer(members[4], 0, 255));
    }
}

}  // namespace raybundle
