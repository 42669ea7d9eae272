// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scene/gltf/file/gltf_document.h"

namespace raybundle {

/// A decoded attribute: `components` floats for every vertex.
struct DracoAttribute {
    std::size_t components = 0;
    std::vector<float> values;
};

/// What KHR_draco_mesh_compression holds instead of accessors.
struct DracoMesh {
    std::size_t vertex_count = 0;
    std::map<std::string, DracoAttribute> attributes;  ///< by semantic, such as "POSITION"
    std::vector<std::uint32_t> indices;
};

/// Decodes the extension object of a primitive. Throws SceneError at `json_path`.
DracoMesh decode_draco(const GltfDocument& document, const tinygltf::Value& extension,
                       const std::string& json_path);

}  // namespace raybundle
