// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "scene/gltf/animation/gltf_animations.h"
#include "scene/gltf/file/gltf_bake.h"
#include "scene/gltf/gltf_geometry.h"

namespace raybundle {

/// Of each geometry, whether animations deform it: they move joints of its skin, or morph it.
std::vector<bool> find_deforming(const GltfDocument& document, const GltfNodeTree& tree,
                                 const std::vector<NodeGeometry>& geometries,
                                 const FileAnimations& animations);

/// Fills in what SceneAnimations says of shapes.
class ShapeLinks {
  public:
    /// Index into SceneAnimations::nodes of a node that something moves; else ShapeJoint::none.
    using FindNode = std::function<std::size_t(int node)>;

    ShapeLinks(GltfDocument& document, const GltfNodeTree& tree,
               const std::vector<NodeGeometry>& geometries, float metres_per_unit,
               FindNode find_node)
        : document_(document),
          tree_(tree),
          geometries_(geometries),
          metres_per_unit_(metres_per_unit),
          find_node_(std::move(find_node)) {}

    void add(const std::vector<BakedPrimitive>& baked, const std::vector<bool>& morphed,
             SceneAnimations& result);
    /// Index into SceneAnimations::morph_weights; DeformingShape::none where nothing is morphed.
    [[nodiscard]] std::size_t morph_of(std::size_t node) const;

  private:
    std::size_t rest_of(int mesh, std::size_t primitive, SceneAnimations& result);
    std::size_t skin_of(int node, SceneAnimations& result);
    void add_morph(int node, SceneAnimations& result);

    GltfDocument& document_;
    const GltfNodeTree& tree_;
    const std::vector<NodeGeometry>& geometries_;
    float metres_per_unit_;
    FindNode find_node_;
    std::map<std::pair<int, std::size_t>, std::size_t> rests_;  // by mesh and primitive
    std::map<int, std::size_t> skins_, morphs_;                 // by the mesh's node
    std::size_t offsets_ = 0;                                   // of morph targets, so far
};

}  // namespace raybundle
