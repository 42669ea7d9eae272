// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/gltf_geometry.h"
#include "scene/gltf/gltf_node_tree.h"
#include "scene/gltf/gltf_objects.h"
#include "scene/scene.h"

namespace raybundle {

/// Adds the planned objects to `scene`, with the vertices of their subtrees in the space of their
/// node, and takes those out of `plans` of which no triangle is left. Mirrored transforms turn the
/// winding round, so that front sides stay front sides in world space; missing normals become flat
/// ones; triangles without area are left out and counted in a notice. `default_material` serves
/// triangles without a material. Throws SceneError for positions beyond 1e9 m.
void bake_objects(GltfDocument& document, const GltfNodeTree& tree,
                  const std::vector<NodeGeometry>& geometries, std::vector<ObjectPlan>& plans,
                  std::uint32_t default_material, Scene& scene);

}  // namespace raybundle
