// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/gltf/saved/glb_parts.h"
#include "scene/gltf/saved/node_writer.h"
#include "scene/gltf/saved/scene_to_save.h"

namespace raybundle {

/// Writes the objects of a scene: moved ones by their node, removed ones not at all, and what the
/// file does not have as such with meshes of their own.
class ObjectWriter {
  public:
    ObjectWriter(const SceneToSave& scene, NodeWriter& nodes, GlbParts& parts,
                 std::vector<std::string>& notes);

    void write();
    /// The node that an object has now, or -1 where it is that of the file.
    [[nodiscard]] int new_node(std::size_t object) const { return new_nodes_[object]; }

  private:
    void write_file_object(std::size_t object);
    void write_apart(std::size_t object, int parent);
    void move_node(std::size_t object);
    void strip(int node);
    [[nodiscard]] std::size_t mesh_of(std::size_t object);
    [[nodiscard]] int parent_for(const Object& object, int file_node);
    void pin(std::size_t object, int node);

    const SceneToSave& scene_;
    NodeWriter& nodes_;
    GlbParts& parts_;
    std::vector<std::string>& notes_;
    std::vector<bool> object_nodes_;                              // of each of the file's nodes
    std::vector<int> new_nodes_;                                  // of each object
    std::map<std::pair<std::size_t, bool>, std::size_t> meshes_;  // by geometry and side
    std::size_t written_ = 0;
};

}  // namespace raybundle
