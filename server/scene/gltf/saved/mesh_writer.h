// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "scene/gltf/saved/glb_parts.h"
#include "scene/gltf/saved/scene_to_save.h"

namespace raybundle {

/// Index of a new mesh: positions, normals, uv, and colours where there are any; a primitive for
/// each material, whose indices are those of Scene::materials. turned: triangles the other way
/// round, for objects that are mirrored.
std::size_t add_mesh(const ObjectGeometry& geometry, const std::string& name, bool turned,
                     GlbParts& parts);

}  // namespace raybundle
