// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/gltf_geometry.h"
#include "scene/gltf/gltf_node_tree.h"
#include "scene/gltf/gltf_objects.h"
#include "scene/scene.h"

namespace raybundle {

/// Vertices of the scene that come from a primitive.
struct BakedPrimitive {
    std::size_t geometry = 0, primitive = 0;  ///< of the geometry list, of its mesh
    std::uint32_t first_vertex = 0;           ///< of Scene::vertices
    std::vector<std::uint32_t> from;          ///< vertex of the primitive, from the first one on
    glm::dmat4 object_from_mesh{1.0};         ///< of a skin: from the world
};

/// Adds the planned objects to `scene`, with the vertices of their subtrees in the space of their
/// node, and takes those out of `plans` of which no triangle is left. Mirrored transforms turn the
/// winding round, so that front sides stay front sides in world space; missing normals become flat
/// ones; triangles without area are left out and counted in a notice. `default_material` serves
/// triangles without a material. Returns where the vertices of those geometries are that are
/// `followed`. Throws SceneError for positions beyond 1e9 m.
std::vector<BakedPrimitive> bake_objects(GltfDocument& document, const GltfNodeTree& tree,
                                         const std::vector<NodeGeometry>& geometries,
                                         std::vector<ObjectPlan>& plans,
                                         std::uint32_t default_material,
                                         const std::vector<bool>& followed, Scene& scene);

}  // namespace raybundle
