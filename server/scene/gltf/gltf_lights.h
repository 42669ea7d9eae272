// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/file/gltf_document.h"
#include "scene/gltf/gltf_node_tree.h"
#include "scene/gltf/gltf_objects.h"
#include "scene/scene.h"

namespace raybundle {

/// Adds the KHR_lights_punctual and EXT_lights_ies lights of the shown scene's visible nodes to
/// scene.punctual_lights, in the order of the nodes and named after them. A light in the subtree of
/// an object belongs to it and moves with it. scene.objects must be those of `plans`. Throws
/// SceneError for indices out of range, profiles that cannot be read, cones without an angle
/// between them and more lights than can be kept.
void read_punctual_lights(GltfDocument& document, const GltfNodeTree& tree,
                          const std::vector<ObjectPlan>& plans, Scene& scene);

}  // namespace raybundle
