// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_skin.h"

#include <fmt/format.h>

#include "scene/animation/deforming_shape.h"
#include "scene/gltf/file/gltf_accessor.h"

namespace raybundle {
std::vector<glm::dmat4> read_joint_binds(const GltfDocument& document, int skin,
                                         float metres_per_unit) {
    const tinygltf::Skin& source = item(document.model().skins, skin);
    const std::vector<int>& joints = source.joints;
    const std::string path = item_path("skins", skin) + ".inverseBindMatrices";
    std::vector<float> inverse_bind;
    if (const int accessor = source.inverseBindMatrices; accessor >= 0) {
        if (item(document.model().accessors, accessor).componentType !=
            TINYGLTF_COMPONENT_TYPE_FLOAT) {
            document.fail(path, "must hold 4x4 matrices of floats");
        }
        inverse_bind = read_floats(document, accessor, 16, path);
        if (inverse_bind.size() < joints.size() * 16) {
            document.fail(path, fmt::format("holds {} matrices for {} joints",
                                            inverse_bind.size() / 16, joints.size()));
        }
    }
    std::vector<glm::dmat4> matrices;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        glm::dmat4 joint_from_bind(1.0);
        for (int i = 0; i < 16 && !inverse_bind.empty(); ++i) {
            joint_from_bind[i / 4][i % 4] = inverse_bind[j * 16 + static_cast<std::size_t>(i)];
        }
        joint_from_bind[3] =
            glm::dvec4(glm::dvec3(joint_from_bind[3]) * double{metres_per_unit}, 1.0);
        matrices.push_back(joint_from_bind);
    }
    return matrices;
}

namespace {

/// World from bind pose, for each joint.
std::vector<glm::dmat4> joint_matrices(const GltfDocument& document, const GltfNodeTree& tree,
                                       int skin, float metres_per_unit) {
    std::vector<glm::dmat4> matrices = read_joint_binds(document, skin, metres_per_unit);
    const std::vector<int>& joints = item(document.model().skins, skin).joints;
    for (std::size_t j = 0; j < matrices.size(); ++j) {
        matrices[j] = item(tree.nodes, joints[j]).world_from_node * matrices[j];
    }
    return matrices;
}

void skin_primitive(const GltfDocument& document, const std::vector<glm::dmat4>& joints,
                    const glm::dmat4& world_from_node, const std::string& path,
                    PrimitiveData& data) {
    for (std::size_t v = 0; v < data.positions.size(); ++v) {
        for (int k = 0; k < 4; ++k) {
            const std::size_t joint = data.joints[v][k];
            if (data.weights[v][k] > 0.0F && joint >= joints.size()) {
                document.fail(path + ".attributes.JOINTS_0",
                              fmt::format("vertex {} refers to joint {}, there are {}", v, joint,
                                          joints.size()));
            }
        }
        // A vertex without weights stays with its node.
        move_vertex(blended_joints(joints, data.joints[v], data.weights[v], world_from_node),
                    data.positions[v], data.normals.empty() ? nullptr : &data.normals[v]);
    }
}

}  // namespace

bool apply_skin(GltfDocument& document, const GltfNodeTree& tree, int skin, int node,
                float metres_per_unit, NodeGeometry& geometry) {
    for (const PrimitiveData& data : geometry.primitives) {
        if (!data.triangles.empty() && (data.joints.empty() || data.weights.empty())) {
            document.note("a skinned mesh without joints and weights follows its node");
            return false;
        }
    }
    document.note("skins are read in the rest pose that the file gives their joints");
    const std::vector<glm::dmat4> joints = joint_matrices(document, tree, skin, metres_per_unit);
    const glm::dmat4& world_from_node = item(tree.nodes, node).world_from_node;
    const std::string mesh_path = item_path("meshes", geometry.mesh);
    for (std::size_t i = 0; i < geometry.primitives.size(); ++i) {
        if (!geometry.primitives[i].triangles.empty()) {
            skin_primitive(document, joints, world_from_node,
                           mesh_path + "." + item_path("primitives", i), geometry.primitives[i]);
        }
    }
    geometry.node_from_mesh = {glm::dmat4(1.0)};
    return true;
}

}  // namespace raybundle
