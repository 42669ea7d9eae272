// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace raybundle {

using Json = nlohmann::json;

// Reads from JSON that has passed check_schema(): types and index ranges are known to be right, so
// that a missing member is the only case left to handle.

/// The member `key`, or nullptr.
inline const Json* find_member(const Json& object, const char* key) {
    const auto it = object.find(key);
    return it == object.end() ? nullptr : &*it;
}

/// The extension `name` of an object, or nullptr.
inline const Json* find_extension(const Json& object, const char* name) {
    const Json* extensions = find_member(object, "extensions");
    return extensions == nullptr ? nullptr : find_member(*extensions, name);
}

/// The top-level array `key`; an empty one if the file has none.
inline const Json& array_or_empty(const Json& object, const char* key) {
    static const Json empty = Json::array();
    const Json* found = find_member(object, key);
    return found == nullptr ? empty : *found;
}

template <typename T>
T value_or(const Json& object, const char* key, T fallback) {
    const Json* found = find_member(object, key);
    return found == nullptr ? fallback : found->get<T>();
}

/// A glTF index, -1 if absent.
inline int index_or_none(const Json& object, const char* key) {
    return value_or(object, key, -1);
}

inline std::size_t size_or(const Json& object, const char* key, std::size_t fallback) {
    return value_or(object, key, fallback);
}

/// A vector of numbers such as glm::vec3.
template <typename Vector>
Vector vector_or(const Json& object, const char* key, Vector fallback) {
    const Json* found = find_member(object, key);
    if (found == nullptr) {
        return fallback;
    }
    Vector result = fallback;
    for (int i = 0; i < Vector::length(); ++i) {
        result[i] = (*found)[static_cast<std::size_t>(i)].get<typename Vector::value_type>();
    }
    return result;
}

/// "nodes[3]"
inline std::string item_path(const char* array, std::size_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

}  // namespace raybundle
