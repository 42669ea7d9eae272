// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "scene/animation/scene_animations.h"

namespace raybundle {

/// What a pointer of KHR_animation_pointer points to.
struct PointerTarget {
    AnimatedValue value = AnimatedValue::translation;
    std::size_t index = 0;  ///< of a node, a light of KHR_lights_punctual, a material
};

/// "/materials/3/emissiveFactor" and so on; nothing for what cannot change while a scene is shown.
std::optional<PointerTarget> parse_animation_pointer(std::string_view pointer);

/// "translation", "rotation" or "scale" of a node; nothing for other names.
std::optional<PointerTarget> node_value(std::string_view name, std::size_t node);

}  // namespace raybundle
