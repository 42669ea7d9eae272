// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/gltf/file/gltf_document.h"
#include "scene/scene.h"

namespace raybundle {

/// A node of the shown scene. Matrices are double: products of deep hierarchies far from the origin
/// keep their precision. Lengths in metres.
struct GltfNode {
    std::string name;
    int parent = -1;
    std::vector<int> children;
    glm::dmat4 parent_from_node{1.0};
    glm::dmat4 world_from_node{1.0};
    /// parent_from_node as translation, rotation, scale; what that cannot express (shear) is left
    /// over: parent_from_node = transform.matrix() * remainder.
    Transform transform;
    glm::dmat4 remainder{1.0};
    bool visible = true;  ///< KHR_node_visibility, its own and its ancestors'
};

/// The nodes of the scene that is shown.
struct GltfNodeTree {
    std::vector<GltfNode> nodes;  ///< as in "nodes"; unused ones keep their defaults
    std::vector<int> roots;
    std::vector<int> order;  ///< nodes of the shown scene, parents before children
    std::string scene_name;
};

/// Checks the whole hierarchy (no cycles, one parent each) and composes world matrices. Throws
/// SceneError.
GltfNodeTree read_node_tree(GltfDocument& document, float metres_per_unit);

/// Moves everything by -offset, m, in double precision.
void take_out_offset(const glm::dvec3& offset, GltfNodeTree& tree);

}  // namespace raybundle
