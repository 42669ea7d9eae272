// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/animation/animation_pointer.h"

#include <charconv>

namespace raybundle {
namespace {

struct Pointer {
    std::string_view before, after;  // of the index
    AnimatedValue value;
};

constexpr std::string_view lights = "/extensions/KHR_lights_punctual/lights/";
constexpr std::string_view materials = "/materials/";
constexpr std::string_view nodes = "/nodes/";

constexpr Pointer pointers[] = {
    {nodes, "/translation", AnimatedValue::translation},
    {nodes, "/rotation", AnimatedValue::rotation},
    {nodes, "/scale", AnimatedValue::scale},
    {lights, "/intensity", AnimatedValue::intensity},
    {lights, "/color", AnimatedValue::colour},
    {lights, "/spot/innerConeAngle", AnimatedValue::inner_cone},
    {lights, "/spot/outerConeAngle", AnimatedValue::outer_cone},
    {materials, "/pbrMetallicRoughness/baseColorFactor", AnimatedValue::base_colour},
    {materials, "/pbrMetallicRoughness/roughnessFactor", AnimatedValue::roughness},
    {materials, "/pbrMetallicRoughness/metallicFactor", AnimatedValue::metallic},
    {materials, "/emissiveFactor", AnimatedValue::emissive_factor},
    {materials, "/extensions/KHR_materials_emissive_strength/emissiveStrength",
     AnimatedValue::emissive_strength},
};

}  // namespace

std::optional<PointerTarget> parse_animation_pointer(std::string_view pointer) {
    for (const Pointer& known : pointers) {
        if (!pointer.starts_with(known.before)) {
            continue;
        }
        const std::string_view rest = pointer.substr(known.before.size());
        std::size_t index = 0;
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
        const auto digits = static_cast<std::size_t>(end - rest.data());
        if (error == std::errc() && rest.substr(digits) == known.after) {
            return PointerTarget{known.value, index};
        }
    }
    return std::nullopt;
}

std::optional<PointerTarget> node_value(std::string_view name, std::size_t node) {
    if (name == "translation") {
        return PointerTarget{AnimatedValue::translation, node};
    }
    if (name == "rotation") {
        return PointerTarget{AnimatedValue::rotation, node};
    }
    return name == "scale" ? std::optional(PointerTarget{AnimatedValue::scale, node})
                           : std::nullopt;
}

}  // namespace raybundle
