// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/file/gltf_document.h"
#include "scene/gltf/gltf_node_tree.h"
#include "scene/scene.h"

namespace raybundle {

/// The perspective cameras of the shown scene, in the order of its nodes, named after their nodes.
/// `bounds` (world) set the distance of the target. Orthographic cameras give a notice.
std::vector<Camera> read_cameras(GltfDocument& document, const GltfNodeTree& tree,
                                 const Bounds& bounds);

}  // namespace raybundle
