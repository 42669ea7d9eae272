// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/file/gltf_json.h"
#include "scene/gltf/file/gltf_model.h"

namespace raybundle {

/// The bytes behind a file's buffers and buffer views, all ranges checked, meshopt-compressed views
/// (EXT_meshopt_compression) decoded. Buffers are read from the JSON array: tinygltf's have no
/// length but that of the bytes that it has loaded itself.
class GltfBuffers {
  public:
    /// Throws SceneError for a missing file, a buffer shorter than it says, a view outside of its
    /// buffer, or compressed data that cannot be decoded.
    GltfBuffers(const std::string& file, const Json& buffers,
                std::optional<std::vector<std::uint8_t>> glb_binary,
                const std::vector<tinygltf::BufferView>& views);

    /// Bytes of a buffer view, by its index in "bufferViews".
    [[nodiscard]] std::span<const std::uint8_t> view(int index) const {
        return views_[static_cast<std::size_t>(index)];
    }

  private:
    void load_buffers(const std::string& file, const Json& buffers,
                      std::optional<std::vector<std::uint8_t>> glb_binary);
    void slice_views(const std::string& file, const std::vector<tinygltf::BufferView>& views);
    std::span<const std::uint8_t> slice(const std::string& file, const std::string& json_path,
                                        const tinygltf::BufferView& range) const;
    std::span<const std::uint8_t> decode_meshopt(const std::string& file,
                                                 const std::string& json_path,
                                                 const tinygltf::BufferView& view,
                                                 const tinygltf::Value& compression);

    std::vector<std::vector<std::uint8_t>> buffers_;
    std::vector<std::vector<std::uint8_t>> decoded_;
    std::vector<std::span<const std::uint8_t>> views_;
    std::size_t decoded_bytes_ = 0;
};

}  // namespace raybundle
