// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/object_kind.h"

namespace raybundle {
namespace {

// A group that covers this share of the scene in two axes is not one thing to move, but a part of
// the scene's structure.
constexpr float group_span = 0.5F;
constexpr float shell_span = 0.7F;
// A slab: this thin compared with the scene, and this close to its outside.
constexpr float slab_thickness = 0.05F;
constexpr float slab_distance = 0.02F;
constexpr float slab_second_span = 0.2F;

void unite(Bounds& bounds, const Bounds& other) {
    bounds.min = glm::min(bounds.min, other.min);
    bounds.max = glm::max(bounds.max, other.max);
}

/// Share of the scene's extent that the bounds cover, for each axis.
glm::vec3 span_of(const Bounds& bounds, const Bounds& scene) {
    glm::vec3 span(1.0F);
    for (int axis = 0; axis < 3; ++axis) {
        if (scene.extent()[axis] > 0.0F) {
            span[axis] = bounds.extent()[axis] / scene.extent()[axis];
        }
    }
    return span;
}

int axes_spanned(const Bounds& bounds, const Bounds& scene, float share) {
    const glm::vec3 span = span_of(bounds, scene);
    return (span.x >= share ? 1 : 0) + (span.y >= share ? 1 : 0) + (span.z >= share ? 1 : 0);
}

/// Part of a floor, wall or ceiling: thin, at the outside of the scene, long in one direction.
bool is_outer_slab(const Bounds& bounds, const Bounds& scene) {
    const float size = std::max({scene.extent().x, scene.extent().y, scene.extent().z});
    const glm::vec3 span = span_of(bounds, scene);
    for (int axis = 0; axis < 3; ++axis) {
        const bool thin = bounds.extent()[axis] <= slab_thickness * size;
        const float distance =
            std::min(bounds.min[axis] - scene.min[axis], scene.max[axis] - bounds.max[axis]);
        const float other_spans[] = {span[(axis + 1) % 3], span[(axis + 2) % 3]};
        if (thin && distance <= slab_distance * size &&
            std::max(other_spans[0], other_spans[1]) >= shell_span &&
            std::min(other_spans[0], other_spans[1]) >= slab_second_span) {
            return true;
        }
    }
    return false;
}

bool is_shell(const Bounds& bounds, const Bounds& scene) {
    return axes_spanned(bounds, scene, shell_span) >= 2 || is_outer_slab(bounds, scene);
}

class Planner {
  public:
    Planner(const GltfDocument& document, const GltfNodeTree& tree,
            const std::vector<NodeGeometry>& geometries, const std::vector<bool>& moved)
        : document_(document),
          tree_(tree),
          geometries_(geometries),
          moved_(moved),
          info_(tree.nodes.size()) {
        gather();
    }

    std::vector<ObjectPlan> plan() {
        // A stack instead of recursion; reversed, so that objects come in the file's order.
        std::vector<int> pending(tree_.roots.rbegin(), tree_.roots.rend());
        while (!pending.empty()) {
            const int node = pending.back();
            pending.pop_back();
            if (!at(node).bearing) {
                continue;
            }
            if (at(node).saved || !is_divided(node)) {
                std::vector<int> apart;
                const std::vector<std::size_t> own = subtree_geometries(node, apart);
                if (!own.empty()) {
                    add_object(node, own);
                }
                pending.insert(pending.end(), apart.rbegin(), apart.rend());
                continue;
            }
            if (at(node).geometry) {
                add_object(node, {*at(node).geometry});
            }
            const std::vector<int>& children = tree_.nodes[index(node)].children;
            pending.insert(pending.end(), children.rbegin(), children.rend());
        }
        std::stable_sort(plans_.begin(), plans_.end(),
                         [this](const ObjectPlan& a, const ObjectPlan& b) {
                             return number_of(a.node) < number_of(b.node);
                         });
        return std::move(plans_);
    }

  private:
    struct NodeInfo {
        std::optional<std::size_t> geometry;
        std::optional<bool> movable;  // extras.movable
        std::optional<SavedObject> saved;
        bool bearing = false;  // geometry in the subtree
        bool bearing_child = false;
        bool decided_below = false;  // extras.movable in a proper descendant with geometry
        Bounds bounds;               // world, of the subtree
    };

    static std::size_t index(int node) { return static_cast<std::size_t>(node); }
    NodeInfo& at(int node) { return info_[index(node)]; }

    std::size_t number_of(int node) {
        return at(node).saved ? at(node).saved->number : SavedObject::last;
    }

    /// Whether an animation moves a node or one above it.
    [[nodiscard]] bool is_carried(int node) const {
        while (node >= 0 && !moved_[index(node)]) {
            node = tree_.nodes[index(node)].parent;
        }
        return node >= 0;
    }

    void gather() {
        for (std::size_t i = 0; i < geometries_.size(); ++i) {
            NodeInfo& info = at(geometries_[i].node);
            info.geometry = i;
            info.bearing = true;
            info.bounds = geometries_[i].world_bounds;
            unite(scene_bounds_, info.bounds);
        }
        // Children come after their parents in `order`: backwards, subtrees are complete.
        for (auto it = tree_.order.rbegin(); it != tree_.order.rend(); ++it) {
            NodeInfo& info = at(*it);
            const tinygltf::Value& extras = item(document_.model().nodes, *it).extras;
            if (extras.Has("movable") && extras.Get("movable").IsBool()) {
                info.movable = extras.Get("movable").Get<bool>();
            }
            info.saved = saved_object(document_.saved(), *it);
            const int parent = tree_.nodes[index(*it)].parent;
            if (parent >= 0 && info.bearing) {
                NodeInfo& above = at(parent);
                above.bearing = above.bearing_child = true;
                above.decided_below |=
                    info.decided_below || info.movable.has_value() || info.saved.has_value();
                unite(above.bounds, info.bounds);
            }
        }
    }

    bool is_divided(int node) {
        const NodeInfo& info = at(node);
        if (info.movable || !info.bearing_child) {
            return false;
        }
        return info.decided_below || axes_spanned(info.bounds, scene_bounds_, group_span) >= 2;
    }

    /// apart: gets nodes below that are saved objects, or that an animation moves, unless the whole
    /// is one thing to move.
    std::vector<std::size_t> subtree_geometries(int root, std::vector<int>& apart) {
        const bool whole = at(root).saved || at(root).movable.value_or(false);
        std::vector<std::size_t> found;
        std::vector<int> pending{root};
        while (!pending.empty()) {
            const int node = pending.back();
            pending.pop_back();
            if (node != root && (at(node).saved || (moved_[index(node)] && !whole))) {
                apart.push_back(node);
                continue;
            }
            if (at(node).geometry) {
                found.push_back(*at(node).geometry);
            }
            const std::vector<int>& children = tree_.nodes[index(node)].children;
            pending.insert(pending.end(), children.rbegin(), children.rend());
        }
        return found;
    }

    void add_object(int node, std::vector<std::size_t> geometries) {
        Bounds bounds;
        for (const std::size_t geometry : geometries) {
            unite(bounds, geometries_[geometry].world_bounds);
        }
        ObjectPlan plan;
        plan.node = node;
        plan.path = path_of(node);
        plan.name = readable_name(name_of(node, geometries.front()),
                                  other_names(node, geometries.front()), plan.path);
        plan.kind = kind_of_names(names_below(node));
        plan.movable =
            is_carried(node) || at(node).movable.value_or(!is_shell(bounds, scene_bounds_));
        plan.geometries = std::move(geometries);
        if (const std::optional<SavedObject>& saved = at(node).saved) {
            plan.name = saved->name.value_or(plan.name);
            plan.kind = saved->kind.value_or(plan.kind);
            plan.movable = saved->movable.value_or(plan.movable);
            plan.path = saved->path.value_or(plan.path);
            plan.whole = saved->whole;
        }
        plans_.push_back(std::move(plan));
    }

    [[nodiscard]] std::vector<std::string> path_of(int node) const {
        std::vector<std::string> path;
        for (int at = tree_.nodes[index(node)].parent; at >= 0;
             at = tree_.nodes[index(at)].parent) {
            if (!tree_.nodes[index(at)].name.empty()) {
                path.insert(path.begin(), tree_.nodes[index(at)].name);
            }
        }
        return path;
    }

    /// What else tells what a node is: its extras, as exporters of IFC write them, and its mesh.
    [[nodiscard]] std::vector<std::string> other_names(int node, std::size_t geometry) const {
        std::vector<std::string> names;
        const tinygltf::Value& extras = item(document_.model().nodes, node).extras;
        for (const char* key :
             {"name", "Name", "ifcClass", "IfcClass", "ifc_class", "type", "Type", "class"}) {
            if (extras.Has(key) && extras.Get(key).IsString()) {
                names.push_back(extras.Get(key).Get<std::string>());
            }
        }
        names.push_back(item(document_.model().meshes, geometries_[geometry].mesh).name);
        return names;
    }

    /// Of a node, its mesh and what is below it, as far as one looks.
    std::vector<std::string> names_below(int root) {
        std::vector<std::string> names;
        std::vector<int> pending{root};
        constexpr std::size_t most = 64;
        while (!pending.empty() && names.size() < most) {
            const int node = pending.back();
            pending.pop_back();
            names.push_back(tree_.nodes[index(node)].name);
            if (at(node).geometry) {
                const int mesh = geometries_[*at(node).geometry].mesh;
                names.push_back(item(document_.model().meshes, mesh).name);
            }
            const std::vector<int>& children = tree_.nodes[index(node)].children;
            pending.insert(pending.end(), children.rbegin(), children.rend());
        }
        return names;
    }

    std::string name_of(int node, std::size_t first_geometry) {
        const std::string& name = tree_.nodes[index(node)].name;
        if (!name.empty()) {
            return name;
        }
        const int mesh = geometries_[first_geometry].mesh;
        const std::string& mesh_name = item(document_.model().meshes, mesh).name;
        return mesh_name.empty() ? fmt::format("object {}", plans_.size() + 1) : mesh_name;
    }

    const GltfDocument& document_;
    const GltfNodeTree& tree_;
    const std::vector<NodeGeometry>& geometries_;
    const std::vector<bool>& moved_;
    std::vector<NodeInfo> info_;
    Bounds scene_bounds_;
    std::vector<ObjectPlan> plans_;
};

}  // namespace

std::vector<ObjectPlan> plan_objects(const GltfDocument& document, const GltfNodeTree& tree,
                                     const std::vector<NodeGeometry>& geometries,
                                     const std::vector<bool>& moved) {
    return Planner(document, tree, geometries, moved).plan();
}

}  // namespace raybundle
