// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/animation/animation_pointer.h"

#include <charconv>

namespace raybundle {
namespace {

struct Pointer {
    std::string_view before, after;  // of the index
    AnimatedValue value;
};

constexpr std::string_view lights_pointer = "/extensions/KHR_lights_punctual/lights/";
constexpr std::string_view materials_pointer = "/materials/";
constexpr std::string_view nodes_pointer = "/nodes/";

constexpr Pointer pointers[] = {
    {nodes_pointer, "/translation", AnimatedValue::translation},
    {nodes_pointer, "/rotation", AnimatedValue::rotation},
    {nodes_pointer, "/scale", AnimatedValue::scale},
    {lights_pointer, "/intensity", AnimatedValue::intensity},
    {lights_pointer, "/color", AnimatedValue::colour},
    {lights_pointer, "/spot/innerConeAngle", AnimatedValue::inner_cone},
    {lights_pointer, "/spot/outerConeAngle", AnimatedValue::outer_cone},
    {materials_pointer, "/pbrMetallicRoughness/baseColorFactor", AnimatedValue::base_colour},
    {materials_pointer, "/pbrMetallicRoughness/roughnessFactor", AnimatedValue::roughness},
    {materials_pointer, "/pbrMetallicRoughness/metallicFactor", AnimatedValue::metallic},
    {materials_pointer, "/emissiveFactor", AnimatedValue::emissive_factor},
    {materials_pointer, "/extensions/KHR_materials_emissive_strength/emissiveStrength",
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
