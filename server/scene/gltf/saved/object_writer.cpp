// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/object_writer.h"

#include <fmt/format.h>

#include "scene/gltf/saved/mesh_writer.h"
#include "scene/gltf/saved/saved_state.h"
#include "scene/mesh/mesh_growth.h"

namespace raybundle {
namespace {

constexpr const char* instancing = "EXT_mesh_gpu_instancing";

bool is_singular(const glm::dmat4& m) {
    return glm::determinant(m) == 0.0;
}

}  // namespace

ObjectWriter::ObjectWriter(const SceneToSave& scene, NodeWriter& nodes, GlbParts& parts,
                           std::vector<std::string>& notes)
    : scene_(scene),
      nodes_(nodes),
      parts_(parts),
      notes_(notes),
      object_nodes_(nodes.size(), false),
      new_nodes_(scene.objects.size(), -1) {
    for (const Object& object : scene.objects) {
        if (object.node >= 0) {
            object_nodes_[static_cast<std::size_t>(object.node)] = true;
        }
    }
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        drop_saved(nodes.at(static_cast<int>(n)), "object");
    }
}

void ObjectWriter::write() {
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
        const Object& object = scene_.objects[i];
        if (object.removed) {
            const bool own = !object.added && !(scene_.divided() && i > 0);
            if (own) {
                strip(object.node);
            }
            continue;
        }
        ++written_;
        if (object.added) {
            write_apart(i, object.world_from_parent == glm::mat4(1.0F)
                               ? -1
                               : parent_for(object, scene_.objects[scene_.geometry_of(i)].node));
        } else {
            write_file_object(i);
        }
    }
}

void ObjectWriter::write_file_object(std::size_t i) {
    const Object& object = scene_.objects[i];
    const bool entangled = scene_.source->entangled[i] && scene_.moved(i);
    if (scene_.divided()) {
        if (!scene_.parts_apart()) {
            if (i == 0) {
                pin(i, object.node);
            }
            return;
        }
        if (i == 0) {
            strip(object.node);
        }
        write_apart(i, parent_for(object, object.node));
    } else if (entangled) {
        strip(object.node);
        write_apart(i, parent_for(object, object.node));
        notes_.push_back(
            fmt::format("object '{}' has moved away from its node, from a skin or from what "
                        "hangs below it: it does not follow animations any more",
                        object.name));
    } else {
        if (scene_.moved(i)) {
            move_node(i);
        }
        pin(i, object.node);
    }
}

/// As an object with a mesh of its own.
void ObjectWriter::write_apart(std::size_t i, int parent) {
    const Object& object = scene_.objects[i];
    const int node = nodes_.add(object.name, parent);
    nodes_.set(node, object.transform);
    const std::size_t mesh = mesh_of(i);
    nodes_.at(node)["mesh"] = mesh;
    new_nodes_[i] = node;
    pin(i, node);
}

void ObjectWriter::move_node(std::size_t i) {
    const Object& object = scene_.objects[i];
    if (nodes_.is_at(object.node, scene_.source->transforms[i])) {
        nodes_.set(object.node, object.transform);
        return;
    }
    // Its node has a shear, or is where single precision would not have put it.
    const glm::dmat4 parent(object.world_from_parent);
    const glm::dmat4 before = parent * glm::dmat4(scene_.source->transforms[i].matrix());
    const glm::dmat4 after = parent * glm::dmat4(object.transform.matrix());
    if (is_singular(before)) {
        notes_.push_back(
            fmt::format("object '{}' has no size: its place is not saved", object.name));
        return;
    }
    nodes_.set_world(object.node,
                     after * glm::inverse(before) * nodes_.world_from_node(object.node));
}

/// Takes out what an object shows.
void ObjectWriter::strip(int root) {
    for (const int node : nodes_.subtree(root, object_nodes_)) {
        Json& json = nodes_.at(node);
        json.erase("mesh");
        json.erase("skin");
        json.erase("weights");
        drop_extension(json, instancing);
    }
}

std::size_t ObjectWriter::mesh_of(std::size_t i) {
    const Object& object = scene_.objects[i];
    const std::size_t source = scene_.geometry_of(i);
    // Readers turn the triangles of mirrored objects round.
    const bool turned = glm::determinant(glm::mat3(object.placement())) < 0.0F;
    const auto known = meshes_.find({source, turned});
    if (known != meshes_.end()) {
        return known->second;
    }
    const std::size_t mesh =
        add_mesh(scene_.geometry.at(source), scene_.objects[source].name, turned, parts_);
    meshes_[{source, turned}] = mesh;
    return mesh;
}

/// A node that is where the object's parent is: that of a node of the file, or a new one.
int ObjectWriter::parent_for(const Object& object, int file_node) {
    const int parent = file_node >= 0 ? nodes_.parent(file_node) : -1;
    const glm::mat4 there(nodes_.world_from_node(parent));
    const glm::mat4& wanted = object.world_from_parent;
    bool same = parent >= 0 || wanted == glm::mat4(1.0F);
    for (int column = 0; parent >= 0 && column < 4; ++column) {
        same = same && there[column] == wanted[column];
    }
    if (same) {
        return parent;
    }
    const int node = nodes_.add(object.name, -1);
    nodes_.set_world(node, glm::dmat4(wanted));
    return node;
}

/// Says what the loader is to take a node for.
void ObjectWriter::pin(std::size_t i, int node) {
    const Object& object = scene_.objects[i];
    Json saved = {{"number", written_},
                  {"name", object.name},
                  {"movable", object.movable},
                  {"kind", kind_name(object.kind)}};
    saved["path"] = object.path;
    if (!scene_.divided() || new_nodes_[i] >= 0) {
        saved["whole"] = true;
    }
    saved_extras(nodes_.at(node))["object"] = std::move(saved);
}

}  // namespace raybundle
