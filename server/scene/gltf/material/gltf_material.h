// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/file/gltf_document.h"
#include "scene/scene.h"

namespace raybundle {

/// Reads "materials" and the textures that they use into `scene`, and appends glTF's default
/// material, whose index it returns. Materials without a name get an empty one. Throws SceneError
/// for images that are missing or cannot be decoded.
std::uint32_t read_materials(GltfDocument& document, Scene& scene);

/// True if a material (-1: the default one) has a texture that is read.
bool material_has_texture(const GltfDocument& document, int material);

/// The uv set that the textures of a material (-1: the default one) use; 0 without a texture.
int uv_set_of_material(const GltfDocument& document, int material);

}  // namespace raybundle
