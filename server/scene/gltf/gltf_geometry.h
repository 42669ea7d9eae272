// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/gltf/file/gltf_document.h"
#include "scene/gltf/gltf_node_tree.h"
#include "scene/gltf/gltf_primitive.h"

namespace raybundle {

/// The mesh of one node, in metres.
struct NodeGeometry {
    int node = -1;
    int mesh = -1;
    std::vector<PrimitiveData> primitives;   ///< as many as the mesh has, some without triangles
    std::vector<glm::dmat4> node_from_mesh;  ///< one for each instance (EXT_mesh_gpu_instancing)
    bool in_world = false;  ///< skinned: vertices are in world space and the node does not count
    Bounds world_bounds;    ///< contains the geometry; not always tight

    [[nodiscard]] std::size_t triangle_count() const;  ///< of all instances
    [[nodiscard]] Bounds local_bounds() const;         ///< of triangles, the mesh's space

    static constexpr std::uint32_t no_vertex = 0xffffffffU;
};

/// Of the morph targets of a node's mesh; empty where nothing says any.
std::vector<float> read_morph_weights(const tinygltf::Node& node, const tinygltf::Mesh& mesh);

/// Reads the meshes of all visible nodes of the shown scene, rest pose. Throws SceneError, also if
/// there is no triangle at all.
std::vector<NodeGeometry> read_geometry(GltfDocument& document, const GltfNodeTree& tree,
                                        float metres_per_unit);

}  // namespace raybundle
