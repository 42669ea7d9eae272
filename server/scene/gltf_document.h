// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf_buffers.h"
#include "scene/gltf_json.h"

namespace raybundle {

struct GltfContainer;

/// A glTF file that has been checked: its JSON by check_schema(), its buffers in memory, its
/// accessors inside of their views. The JSON is read with nlohmann::json, the parser inside of
/// tinygltf, and not through tinygltf's model: that drops members of a wrong type without a word,
/// and refuses valid files whose index accessors have no view (Draco) or whose buffers have no
/// bytes of their own (meshopt).
class GltfDocument {
  public:
    /// Throws SceneError.
    explicit GltfDocument(const std::string& path);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const Json& json() const { return json_; }
    /// A top-level array such as "nodes"; empty if absent.
    [[nodiscard]] const Json& array(const char* name) const { return array_or_empty(json_, name); }
    [[nodiscard]] const Json& item(const char* name, int index) const {
        return array(name)[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] std::span<const std::uint8_t> view_bytes(int view) const {
        return buffers_.view(view);
    }

    /// Adds a notice for the user, once.
    void note(const std::string& text);
    [[nodiscard]] const std::vector<std::string>& notices() const { return notices_; }

    [[noreturn]] void fail(const std::string& json_path, const std::string& reason) const;

  private:
    GltfDocument(const std::string& path, GltfContainer container);

    std::string path_;
    Json json_;
    GltfBuffers buffers_;
    std::vector<std::string> notices_;
};

}  // namespace raybundle
