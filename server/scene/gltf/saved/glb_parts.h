// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/file/gltf_container.h"

namespace raybundle {

/// A GLB file that is being made: its JSON, and the one buffer that all of its bytes are in.
struct GlbParts {
    std::string path;  ///< of the file that it is made from, for errors
    Json json = Json::object();
    std::vector<std::uint8_t> binary;

    /// Index of a new buffer view of these bytes, which begin at a multiple of 4.
    std::size_t add_view(std::span<const std::uint8_t> bytes);
    /// Index of a new accessor of floats (5126) or indices (5125). type: "VEC3" and so on.
    std::size_t add_accessor(std::span<const std::uint8_t> bytes, int component_type,
                             std::size_t count, const char* type);
    /// Index of a new item of a top-level array.
    std::size_t add(const char* array, Json item);
    /// Adds it to "extensionsUsed".
    void use(const std::string& extension);
};

/// What a file holds with what it refers to: its buffers, images and photometric files. Throws
/// SceneError.
GlbParts embed(const std::string& path, GltfContainer container);

/// The bytes of the file. Throws SceneError where it would be larger than the loader takes.
std::string glb_bytes(GlbParts parts);

/// The object `extras.raybundle` of an item, which is made where there is none.
Json& saved_extras(Json& item);
/// Takes a member out of it, and out of the item what is empty then.
void drop_saved(Json& item, const char* key);

/// Takes an extension out of an item.
void drop_extension(Json& item, const char* name);

/// "data:application/octet-stream;base64,..."
std::string data_uri(std::span<const std::uint8_t> bytes);

}  // namespace raybundle
