// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf/gltf_geometry.h"

namespace raybundle {

/// Moves the vertices of a skinned node to world space by its joints where the file has them
/// (glTF 2.0, 3.7.3.1: the transform of the node itself does not count). False, and nothing moved,
/// if the node's mesh has no joints. Throws SceneError for joints that do not exist.
bool apply_skin(GltfDocument& document, const GltfNodeTree& tree, int skin, int node,
                float metres_per_unit, NodeGeometry& geometry);

/// Joint from bind pose, for each joint of a skin; lengths in m. Throws SceneError.
std::vector<glm::dmat4> read_joint_binds(const GltfDocument& document, int skin,
                                         float metres_per_unit);

}  // namespace raybundle
