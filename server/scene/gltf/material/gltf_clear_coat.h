// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/file/gltf_document.h"
#include "scene/gltf/file/gltf_model.h"
#include "scene/scene.h"

namespace raybundle {

/// KHR_materials_clearcoat, after all else of the material has been read. Textures of factor and
/// roughness count as their means, and the coat follows the geometry: its normal map is ignored.
/// What emits, transmits or is unlit, and a max-Phong surface, stay without a coat. Notices say so.
void read_clear_coat(GltfDocument& document, const tinygltf::Material& source, Material& material);

}  // namespace raybundle
