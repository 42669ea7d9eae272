// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_node_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/gtx/matrix_decompose.hpp>
#include <limits>
#include <utility>

namespace raybundle {
namespace {

std::string node_path(std::size_t node) {
    return item_path("nodes", node);
}

bool nearly_equal(const glm::dmat4& a, const glm::dmat4& b, double tolerance) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (std::abs(a[column][row] - b[column][row]) > tolerance) {
                return false;
            }
        }
    }
    return true;
}

/// A node given as a matrix: the nearest TRS, and the remainder that it cannot express.
void decompose(GltfNode& node) {
    glm::dvec3 scale, translation, skew;
    glm::dvec4 perspective;
    glm::dquat rotation;
    if (!glm::decompose(node.parent_from_node, scale, rotation, translation, skew, perspective)) {
        // Singular: nothing can be divided out, so that vertices carry all of it.
        node.remainder = node.parent_from_node;
        return;
    }
    node.transform.translation = translation;
    node.transform.rotation = glm::normalize(rotation);
    node.transform.scale = scale;
    glm::dmat4 trs(node.transform.matrix());
    trs[3] = node.parent_from_node[3];  // far away single precision has rounded it
    const glm::dmat4 remainder = glm::inverse(trs) * node.parent_from_node;
    // Rounding of an ordinary TRS is not worth touching every vertex for.
    const bool ordinary = nearly_equal(remainder, glm::dmat4(1.0), 1e-5);
    node.remainder = ordinary ? glm::dmat4(1.0) : remainder;
    if (ordinary) {
        node.parent_from_node = trs;
    }
}

void read_matrix(const GltfDocument& document, const std::vector<double>& matrix,
                 const std::string& path, float metres_per_unit, GltfNode& node) {
    node.parent_from_node = glm::make_mat4(matrix.data());
    const glm::dmat4& m = node.parent_from_node;
    const glm::dvec4 last_row(m[0][3], m[1][3], m[2][3], m[3][3]);
    if (glm::length(last_row - glm::dvec4(0, 0, 0, 1)) > 1e-6) {
        document.fail(path + ".matrix", "the last row must be 0 0 0 1");
    }
    node.parent_from_node[3] = glm::dvec4(glm::dvec3(m[3]) * double{metres_per_unit}, 1.0);
    decompose(node);
}

/// What is of length 1 within the rounding of its square keeps its bits.
glm::quat unit(const glm::quat& q) {
    constexpr float square_rounding = 4.0F * std::numeric_limits<float>::epsilon();
    return std::abs(glm::dot(q, q) - 1.0F) <= square_rounding ? q : glm::normalize(q);
}

void read_transform(GltfDocument& document, const tinygltf::Node& source, const std::string& path,
                    float metres_per_unit, GltfNode& node) {
    if (!source.matrix.empty()) {
        read_matrix(document, source.matrix, path, metres_per_unit, node);
        return;
    }
    const glm::dvec3 translation =
        vector_or(source.translation, glm::dvec3(0.0)) * double{metres_per_unit};
    node.transform.translation = glm::vec3(translation);
    node.transform.scale = vector_or(source.scale, glm::vec3(1.0F));
    const glm::vec4 xyzw = vector_or(source.rotation, glm::vec4(0.0F, 0.0F, 0.0F, 1.0F));
    if (glm::length(xyzw) < 1e-6F) {
        document.fail(path + ".rotation", "is zero, not a unit quaternion");
    }
    node.transform.rotation = unit(glm::quat(xyzw.w, xyzw.x, xyzw.y, xyzw.z));
    node.parent_from_node = glm::dmat4(node.transform.matrix());
    node.parent_from_node[3] = glm::dvec4(translation, 1.0);
}

void read_node(GltfDocument& document, std::size_t index, float metres_per_unit,
               GltfNodeTree& tree) {
    const tinygltf::Node& source = document.model().nodes[index];
    GltfNode& node = tree.nodes[index];
    node.name = source.name;
    read_transform(document, source, node_path(index), metres_per_unit, node);
    const auto* visibility = find_extension(source.extensions, "KHR_node_visibility");
    node.visible = visibility == nullptr || !visibility->Has("visible") ||
                   visibility->Get("visible").Get<bool>();
    for (const int child : source.children) {
        GltfNode& child_node = tree.nodes[static_cast<std::size_t>(child)];
        if (child_node.parent >= 0) {
            document.fail(
                fmt::format("{}.children[{}]", node_path(index), node.children.size()),
                fmt::format("node {} already has the parent {}", child, child_node.parent));
        }
        child_node.parent = static_cast<int>(index);
        node.children.push_back(child);
    }
}

/// With one parent each, a node is on a cycle or below one if climbing up never ends.
void check_cycles(const GltfDocument& document, const GltfNodeTree& tree) {
    enum class Mark : char { unknown, climbing, rooted };
    std::vector<Mark> marks(tree.nodes.size(), Mark::unknown);
    std::vector<std::size_t> climbed;
    for (std::size_t start = 0; start < tree.nodes.size(); ++start) {
        climbed.clear();
        int at = static_cast<int>(start);
        while (at >= 0 && marks[static_cast<std::size_t>(at)] != Mark::rooted) {
            const auto node = static_cast<std::size_t>(at);
            if (marks[node] == Mark::climbing) {
                document.fail(node_path(node), "is its own ancestor");
            }
            marks[node] = Mark::climbing;
            climbed.push_back(node);
            at = tree.nodes[node].parent;
        }
        for (const std::size_t node : climbed) {
            marks[node] = Mark::rooted;
        }
    }
}

void check_roots(const GltfDocument& document, const GltfNodeTree& tree) {
    const std::vector<tinygltf::Scene>& scenes = document.model().scenes;
    for (std::size_t s = 0; s < scenes.size(); ++s) {
        std::vector<bool> seen(tree.nodes.size(), false);
        std::size_t entry = 0;
        for (const int root : scenes[s].nodes) {
            const auto node = static_cast<std::size_t>(root);
            const std::string path = fmt::format("scenes[{}].nodes[{}]", s, entry++);
            if (tree.nodes[node].parent >= 0) {
                document.fail(path, fmt::format("node {} is not a root: its parent is {}", node,
                                                tree.nodes[node].parent));
            }
            if (seen[node]) {
                document.fail(path, fmt::format("node {} is listed twice", node));
            }
            seen[node] = true;
        }
    }
}

void choose_scene(GltfDocument& document, GltfNodeTree& tree) {
    const std::vector<tinygltf::Scene>& scenes = document.model().scenes;
    if (scenes.empty()) {
        document.note("the file has no scene: all root nodes are shown");
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            if (tree.nodes[i].parent < 0) {
                tree.roots.push_back(static_cast<int>(i));
            }
        }
        return;
    }
    const int shown = std::max(document.model().defaultScene, 0);
    if (scenes.size() > 1) {
        document.note(fmt::format("scene {} of {} is shown", shown, scenes.size()));
    }
    tree.scene_name = item(scenes, shown).name;
    tree.roots = item(scenes, shown).nodes;
}

/// All nodes below `roots`, parents first; without recursion, as hierarchies can be deeper than the
/// stack.
std::vector<int> breadth_first(const GltfNodeTree& tree, std::vector<int> roots) {
    std::vector<int> order = std::move(roots);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::vector<int>& children = tree.nodes[static_cast<std::size_t>(order[i])].children;
        order.insert(order.end(), children.begin(), children.end());
    }
    return order;
}

/// Of all nodes, as the joints of a skin need not be in the shown scene.
void compose_world_matrices(GltfNodeTree& tree) {
    std::vector<int> parentless;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        if (tree.nodes[i].parent < 0) {
            parentless.push_back(static_cast<int>(i));
        }
    }
    for (const int index : breadth_first(tree, std::move(parentless))) {
        GltfNode& node = tree.nodes[static_cast<std::size_t>(index)];
        node.world_from_node = node.parent_from_node;
        if (node.parent >= 0) {
            const GltfNode& parent = tree.nodes[static_cast<std::size_t>(node.parent)];
            node.world_from_node = parent.world_from_node * node.parent_from_node;
            node.visible = node.visible && parent.visible;
        }
    }
}

}  // namespace

void take_out_offset(const glm::dvec3& offset, GltfNodeTree& tree) {
    for (GltfNode& node : tree.nodes) {
        if (node.parent >= 0) {
            continue;
        }
        node.parent_from_node[3] -= glm::dvec4(offset, 0.0);
        if (glm::dvec3(node.remainder[3]) == glm::dvec3(0.0)) {
            node.transform.translation = glm::vec3(node.parent_from_node[3]);
        } else {  // all of it, see decompose()
            node.remainder[3] -= glm::dvec4(offset, 0.0);
        }
    }
    compose_world_matrices(tree);
}

GltfNodeTree read_node_tree(GltfDocument& document, float metres_per_unit) {
    GltfNodeTree tree;
    tree.nodes.resize(document.model().nodes.size());
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        read_node(document, i, metres_per_unit, tree);
    }
    check_cycles(document, tree);
    check_roots(document, tree);
    choose_scene(document, tree);
    compose_world_matrices(tree);
    tree.order = breadth_first(tree, tree.roots);
    return tree;
}

}  // namespace raybundle
