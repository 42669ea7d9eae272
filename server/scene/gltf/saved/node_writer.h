// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/saved/glb_parts.h"
#include "scene/scene.h"

namespace raybundle {

/// The nodes of a file that is being made. Lengths in metres; its own may be in other units.
class NodeWriter {
  public:
    NodeWriter(GlbParts& parts, float metres_per_unit, const glm::dvec3& origin);

    [[nodiscard]] Json& at(int node) { return parts_.json["nodes"][index(node)]; }
    [[nodiscard]] int parent(int node) const { return parents_[index(node)]; }
    /// Of a node, or, for -1, of what has no parent; with the scene's own zero.
    [[nodiscard]] glm::dmat4 world_from_node(int node) const;

    /// A new node below another one, or, for -1, one of the scene's roots.
    int add(const std::string& name, int parent);
    void set(int node, const Transform& transform);
    void set(int node, const glm::dmat4& parent_from_node);
    /// Puts a node there in the world.
    void set_world(int node, const glm::dmat4& world_from_node);
    /// Whether a node has the transform as single precision has it.
    [[nodiscard]] bool is_at(int node, const Transform& transform) const;
    /// Nodes below one and itself, without those of `others` and what is below them.
    [[nodiscard]] std::vector<int> subtree(int root, const std::vector<bool>& others);
    [[nodiscard]] std::size_t size() const { return parents_.size(); }
    /// The scene that is shown.
    [[nodiscard]] Json& scene();

  private:
    static std::size_t index(int node) { return static_cast<std::size_t>(node); }
    [[nodiscard]] glm::dmat4 local(std::size_t node) const;

    GlbParts& parts_;
    double metres_per_unit_;
    glm::dvec3 origin_;
    std::vector<int> parents_;
};

}  // namespace raybundle
