// SPDX-License-Identifier: Apache-2.0
// What skins and morph targets make vertices of.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace raybundle {

/// Offsets that a morph weight of 1 adds; empty where the file has none.
struct MorphTarget {
    std::vector<glm::vec3> positions, normals;
};

/// For places and normals alike; without offsets they stay.
inline void add_offsets(std::span<const glm::vec3> offsets, float weight, std::span<glm::vec3> to) {
    for (std::size_t v = 0; v < std::min(offsets.size(), to.size()); ++v) {
        to[v] += weight * offsets[v];
    }
}

/// Vertices of a mesh primitive as the file has them, before morph targets and skin, in its units.
struct RestShape {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< empty: faces are flat
    std::vector<glm::uvec4> joints;
    std::vector<glm::vec4> weights;  ///< of the joints
    std::vector<MorphTarget> targets;
};

/// A node that vertices follow.
struct ShapeJoint {
    std::size_t node = none;    ///< index into SceneAnimations::nodes; none: nothing moves it
    glm::dmat4 world{1.0};      ///< world from node, where the file puts it
    glm::dmat4 from_bind{1.0};  ///< node from the mesh's space; lengths in m

    static constexpr std::size_t none = static_cast<std::size_t>(-1);
};

/// A skin as one node of the file uses it.
struct ShapeSkin {
    std::vector<ShapeJoint> joints;
    ShapeJoint own;  ///< the node of the mesh, for vertices without weights
};

/// Vertices of the scene that come from one primitive.
struct DeformingShape {
    std::size_t rest = 0;             ///< index into SceneAnimations::rests
    std::size_t skin = none;          ///< index into SceneAnimations::skins
    std::size_t morph = none;         ///< index into SceneAnimations::morph_weights
    std::uint32_t first_vertex = 0;   ///< of Scene::vertices, which has as many in a row as:
    std::vector<std::uint32_t> from;  ///< vertex of the rest shape that each comes from
    glm::dmat4 object_from_mesh{1.0};

    static constexpr std::size_t none = static_cast<std::size_t>(-1);
};

/// World from the mesh's space for a vertex (glTF 2.0, 3.7.3.3). joints: of the skin. Those with
/// a weight must exist. otherwise: for a vertex without weights.
inline glm::dmat4 blended_joints(std::span<const glm::dmat4> joints, const glm::uvec4& joint,
                                 const glm::vec4& weight, const glm::dmat4& otherwise) {
    glm::dmat4 blended(0.0);
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
        if (const auto share = static_cast<double>(weight[k]); share > 0.0) {
            blended += share * joints[joint[k]];
            sum += share;
        }
    }
    return sum > 0.0 ? blended / sum : otherwise;
}

/// Moves a vertex; normal may be null, and is not of unit length afterwards.
inline void move_vertex(const glm::dmat4& matrix, glm::vec3& position, glm::vec3* normal) {
    position = glm::vec3(matrix * glm::dvec4(position, 1.0));
    if (normal != nullptr) {
        *normal = glm::vec3(glm::transpose(glm::inverse(glm::dmat3(matrix))) * glm::dvec3(*normal));
    }
}

}  // namespace raybundle
