// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/saved/glb_parts.h"
#include "scene/gltf/saved/scene_to_save.h"

namespace raybundle {

/// Writes the materials of a scene, those of files that have been added with their textures. Item i
/// of "materials" is then Scene::materials[i].
void write_materials(const SceneToSave& scene, GlbParts& parts);

}  // namespace raybundle
