// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/file/gltf_document.h"
#include "scene/scene.h"

namespace raybundle {

/// KHR_materials_transmission and KHR_materials_volume.
void read_transmission(GltfDocument& document, const tinygltf::Material& source,
                       Material& material);

/// KHR_materials_diffuse_transmission: the Lambert part becomes
/// (1 - factor) base colour reflected + factor colour transmitted.
void read_diffuse_transmission(GltfDocument& document, const tinygltf::Material& source,
                               Material& material);

/// A material that transmits some, but less than half of the light sends that diffusely from its
/// other side and reflects the rest of its base colour, without gloss: a veil. For all other
/// members of the material have to be read.
void spread_part_transmission(GltfDocument& document, const Scene& scene, Material& material);

}  // namespace raybundle
