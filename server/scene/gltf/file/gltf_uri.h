// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raybundle {

/// Bytes of a glTF "uri": a data URI, or a file relative to the scene's folder. A relative path may
/// contain "..", as scenes share textures that way; absolute paths and other schemes (http:, file:)
/// are refused, so that a scene cannot name what its author did not ship with it.
/// Throws SceneError at `json_path`.
std::vector<std::uint8_t> read_uri(const std::string& scene_file, const std::string& json_path,
                                   const std::string& uri, std::uint64_t max_bytes);

/// As read_uri(), but only makes sure that a referenced file exists.
void check_uri(const std::string& scene_file, const std::string& json_path, const std::string& uri);

/// The file that a relative reference names. Where there is none of that name it is the only one in
/// the scene's folder whose name is spelt differently, see gltf_similar_file.h. Throws SceneError
/// for what read_uri() refuses.
std::string local_file(const std::string& scene_file, const std::string& json_path,
                       const std::string& uri);

/// The name of that file, relative to the scene's folder, where it is spelt differently.
std::optional<std::string> other_spelling(const std::string& scene_file,
                                          const std::string& json_path, const std::string& uri);

/// "%20" becomes a space; a "%" that starts no escape stays as it is.
std::string percent_decoded(std::string_view text);

}  // namespace raybundle
