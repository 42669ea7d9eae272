// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/gltf/gltf_geometry.h"

namespace raybundle {

/// What becomes one object: a node, and which geometry of its subtree moves with it.
struct ObjectPlan {
    int node = -1;
    std::string name;
    bool movable = false;
    ObjectKind kind = ObjectKind::thing;
    std::vector<std::string> path;        ///< names of the nodes above, the outermost first
    std::vector<std::size_t> geometries;  ///< indices into the geometry list
    bool whole = false;                   ///< not to be divided into its parts
};

/// Divides the scene into objects that are not nested in one another. A node with
/// `extras.movable` is an object of its own. Elsewhere the outermost subtree that does not span
/// most of the scene is one (a table with its legs); groups and rooms that span it are divided
/// further. Objects are movable unless they belong to the enclosing shell (floor, walls, ceiling,
/// judged by their size and place) or `extras.movable` is false.
///
/// Nodes that a saved scene says were objects are those, in the order that they had; what is not
/// below them is divided as above.
///
/// moved: of each node, whether an animation moves it. Such a node is an object of its own and
/// movable, unless it is part of one that `extras.movable` makes a whole.
std::vector<ObjectPlan> plan_objects(const GltfDocument& document, const GltfNodeTree& tree,
                                     const std::vector<NodeGeometry>& geometries,
                                     const std::vector<bool>& moved);

}  // namespace raybundle
