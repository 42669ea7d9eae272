// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/animation/deforming_shape.h"
#include "scene/gltf/file/gltf_document.h"

namespace raybundle {

/// Triangles of one mesh primitive, in the mesh's own units. Per-vertex arrays are as long as
/// `positions`, or empty where the file has no such attribute.
struct PrimitiveData {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec3> colours;  ///< COLOR_0 without alpha, linear, 0 to 1
    std::vector<glm::uvec4> joints;
    std::vector<glm::vec4> weights;
    std::vector<glm::uvec3> triangles;  ///< counter-clockwise from the front
    int material = -1;                  ///< index into "materials", -1: glTF's default material
};

/// Checks the triangle indices of all meshes, shown or not. Throws SceneError.
void check_meshes(const GltfDocument& document);

/// Reads a primitive at `json_path`, morph targets applied with `morph_weights`. Points and lines
/// give no triangles and a notice. Throws SceneError.
PrimitiveData read_primitive(GltfDocument& document, const tinygltf::Primitive& primitive,
                             const std::vector<float>& morph_weights, const std::string& json_path);

/// Of a primitive whose vertices are `data`. Throws SceneError where their numbers differ.
std::vector<MorphTarget> read_morph_targets(const GltfDocument& document,
                                            const tinygltf::Primitive& primitive,
                                            const std::string& json_path,
                                            const PrimitiveData& data);

}  // namespace raybundle
