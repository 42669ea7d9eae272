// SPDX-License-Identifier: Apache-2.0
// Values of `extras.raybundle` of a saved scene: nothing where there is none, where it has another
// type, or where it is out of its range.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "scene/gltf/file/gltf_json.h"

namespace raybundle {

constexpr float max_saved_number = 1e12F;

std::optional<float> number_in(const Json& json, const char* key, float low, float high);
std::optional<bool> flag_of(const Json& json, const char* key);
/// At most 500 bytes.
std::optional<std::string> text_of(const Json& json, const char* key);
std::optional<glm::vec3> vector_of(const Json& json, const char* key, float low, float high);

/// So many, each in the range.
template <std::size_t Count>
std::optional<std::array<float, Count>> numbers_of(const Json& json, const char* key, float low,
                                                   float high) {
    const Json* found = find_member(json, key);
    if (found == nullptr || !found->is_array() || found->size() != Count) {
        return std::nullopt;
    }
    std::array<float, Count> result{};
    for (std::size_t i = 0; i < Count; ++i) {
        const Json& value = (*found)[i];
        if (!value.is_number() || !(value.get<double>() >= double{low}) ||
            !(value.get<double>() <= double{high})) {
            return std::nullopt;
        }
        result[i] = value.get<float>();
    }
    return result;
}

}  // namespace raybundle
