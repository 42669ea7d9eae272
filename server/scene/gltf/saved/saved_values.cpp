// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/saved_values.h"

namespace raybundle {

namespace {

constexpr std::size_t max_saved_text = 500;

}  // namespace

std::optional<float> number_in(const Json& json, const char* key, float low, float high) {
    const Json* found = find_member(json, key);
    if (found == nullptr || !found->is_number()) {
        return std::nullopt;
    }
    const auto value = found->get<double>();
    return value >= double{low} && value <= double{high} ? std::optional(static_cast<float>(value))
                                                         : std::nullopt;
}

std::optional<bool> flag_of(const Json& json, const char* key) {
    const Json* found = find_member(json, key);
    return found != nullptr && found->is_boolean() ? std::optional(found->get<bool>())
                                                   : std::nullopt;
}

std::optional<std::string> text_of(const Json& json, const char* key) {
    const Json* found = find_member(json, key);
    return found != nullptr && found->is_string() &&
                   found->get_ref<const std::string&>().size() <= max_saved_text
               ? std::optional(found->get<std::string>())
               : std::nullopt;
}

std::optional<glm::vec3> vector_of(const Json& json, const char* key, float low, float high) {
    const auto found = numbers_of<3>(json, key, low, high);
    return found ? std::optional(glm::vec3((*found)[0], (*found)[1], (*found)[2])) : std::nullopt;
}

}  // namespace raybundle
