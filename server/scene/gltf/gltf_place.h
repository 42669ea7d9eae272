// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/gltf/gltf_geometry.h"
#include "scene/gltf/gltf_node_tree.h"
#include "scene/scene.h"

namespace raybundle {

/// Reads the geometry that counts, near zero. Triangles too far away to matter are left out, and
/// named in a notice (scene/neighbourhood.h). Where single precision would move surfaces by more
/// than what bundles tell apart, the scene's whole offset is taken out of the roots of `tree`, and
/// becomes scene.origin, with a notice; another one tells of meshes whose own vertices are so far
/// away. Throws SceneError.
std::vector<NodeGeometry> read_placed_geometry(GltfDocument& document, GltfNodeTree& tree,
                                               float metres_per_unit, Scene& scene);

}  // namespace raybundle
