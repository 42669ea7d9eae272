// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/file/gltf_json.h"

namespace raybundle {

/// Size and hash of a file's bytes, to notice that it has become another one.
struct FileMark {
    std::size_t bytes = 0, hash = 0;
    bool operator==(const FileMark&) const = default;
};

/// What a .gltf or .glb file holds, before anything in it is interpreted.
struct GltfContainer {
    Json json;
    std::optional<std::vector<std::uint8_t>> binary;  ///< the BIN chunk of a .glb
    FileMark mark{};                                  ///< of the file's bytes
};

/// Reads the file and parses its JSON; told apart by content, not by file name. Throws SceneError.
GltfContainer read_gltf_container(const std::string& path);

/// The same of bytes in memory; `path` is what errors name.
GltfContainer parse_gltf_container(const std::string& path, std::span<const std::uint8_t> file);

/// Throws SceneError naming `scene_file` and `json_path` where `path` is no regular file.
void require_file(const std::string& path, const std::string& scene_file,
                  const std::string& json_path);

/// The whole file, if it is a regular one of at most `max_bytes`; otherwise throws SceneError
/// naming `scene_file`, `json_path` and the file that could not be read.
std::vector<std::uint8_t> read_file_bounded(const std::string& path, std::uint64_t max_bytes,
                                            const std::string& scene_file,
                                            const std::string& json_path);

}  // namespace raybundle
