// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

namespace raybundle {

using Json = nlohmann::json;

/// The member `key`, or nullptr.
inline const Json* find_member(const Json& object, const char* key) {
    const auto it = object.find(key);
    return it == object.end() ? nullptr : &*it;
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

}  // namespace raybundle
