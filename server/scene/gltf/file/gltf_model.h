// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/gltf/file/gltf_json.h"

namespace raybundle {

/// Reads JSON that has passed check_schema() with tinygltf, which only meets the members that the
/// scene is made from; they are moved out of `json`. Missing in the model: animations, buffers
/// (GltfBuffers) and images (read_images()), as tinygltf cannot read the latter two without
/// opening files and decoding. Throws SceneError with tinygltf's message if it refuses the file.
tinygltf::Model read_model(const std::string& file, Json& json);

// Reads from that model: types and index ranges are known to be right, so that a missing member is
// the only case left to handle.

/// What a glTF index refers to.
template <typename T>
const T& item(const std::vector<T>& items, int index) {
    return items[static_cast<std::size_t>(index)];
}

/// "nodes[3]"
template <typename Index>
std::string item_path(const char* array, Index index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

/// The extension `name`, an object, or nullptr.
inline const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions,
                                             const char* name) {
    const auto it = extensions.find(name);
    return it == extensions.end() ? nullptr : &it->second;
}

inline int integer_or(const tinygltf::Value& object, const char* key, int fallback) {
    return object.Has(key) ? object.Get(key).GetNumberAsInt() : fallback;
}

inline float number_or(const tinygltf::Value& object, const char* key, float fallback) {
    return object.Has(key) ? static_cast<float>(object.Get(key).GetNumberAsDouble()) : fallback;
}

/// A vector such as glm::vec3 from as many numbers, or from none.
template <typename Vector>
Vector vector_or(const std::vector<double>& numbers, Vector fallback) {
    Vector result = fallback;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        result[static_cast<int>(i)] = static_cast<typename Vector::value_type>(numbers[i]);
    }
    return result;
}

template <typename Vector>
Vector vector_or(const tinygltf::Value& object, const char* key, Vector fallback) {
    Vector result = fallback;
    for (int i = 0; object.Has(key) && i < Vector::length(); ++i) {
        result[i] = static_cast<float>(object.Get(key).Get(i).GetNumberAsDouble());
    }
    return result;
}

}  // namespace raybundle
