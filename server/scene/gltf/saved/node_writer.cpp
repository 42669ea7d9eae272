// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/node_writer.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace raybundle {
namespace {

constexpr double place_rounding = 1e-5;  // as the loader's, of ordinary transforms

bool nearly(const glm::dmat4& a, const glm::dmat4& b) {
    for (int column = 0; column < 4; ++column) {
        const double size = std::max(1.0, glm::length(b[column]));
        if (!(glm::length(a[column] - b[column]) <= place_rounding * size)) {
            return false;
        }
    }
    return true;
}

}  // namespace

NodeWriter::NodeWriter(GlbParts& parts, float metres_per_unit, const glm::dvec3& origin)
    : parts_(parts), metres_per_unit_(metres_per_unit), origin_(origin) {
    Json& nodes = parts_.json["nodes"];
    nodes = nodes.is_null() ? Json::array() : nodes;
    parents_.assign(nodes.size(), -1);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        for (const Json& child : array_or_empty(nodes[n], "children")) {
            parents_[child.get<std::size_t>()] = static_cast<int>(n);
        }
    }
    if (array_or_empty(parts_.json, "scenes").empty()) {
        Json roots = Json::array();
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            if (parents_[n] < 0) {
                roots.push_back(n);
            }
        }
        parts_.json["scenes"] = Json::array({{{"nodes", roots}}});
        parts_.json["scene"] = 0;
    }
}

Json& NodeWriter::scene() {
    return parts_.json["scenes"][value_or<std::size_t>(parts_.json, "scene", 0)];
}

glm::dmat4 NodeWriter::local(std::size_t node) const {
    const Json& json = parts_.json["nodes"][node];
    const auto vector = [&](const char* key, glm::dvec4 fallback) {
        const Json& values = array_or_empty(json, key);
        for (std::size_t i = 0; i < values.size(); ++i) {
            fallback[static_cast<int>(i)] = values[i].get<double>();
        }
        return fallback;
    };
    glm::dmat4 result(1.0);
    if (const Json* matrix = find_member(json, "matrix")) {
        for (int i = 0; i < 16; ++i) {
            result[i / 4][i % 4] = (*matrix)[static_cast<std::size_t>(i)].get<double>();
        }
    } else {
        const glm::dvec4 q = vector("rotation", {0.0, 0.0, 0.0, 1.0});
        const glm::dmat4 turned = glm::mat4_cast(glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)));
        const glm::dvec3 scale(vector("scale", {1.0, 1.0, 1.0, 0.0}));
        result = glm::scale(turned, scale);
        result[3] = glm::dvec4(glm::dvec3(vector("translation", glm::dvec4(0.0))), 1.0);
    }
    result[3] = glm::dvec4(glm::dvec3(result[3]) * metres_per_unit_, 1.0);
    return result;
}

glm::dmat4 NodeWriter::world_from_node(int node) const {
    glm::dmat4 world(1.0);
    for (; node >= 0; node = parents_[index(node)]) {
        world = local(index(node)) * world;
    }
    return glm::translate(glm::dmat4(1.0), -origin_) * world;
}

int NodeWriter::add(const std::string& name, int parent) {
    const auto node = static_cast<int>(parts_.add("nodes", {{"name", name}}));
    parents_.push_back(parent);
    Json& above = parent < 0 ? scene()["nodes"] : at(parent)["children"];
    above = above.is_null() ? Json::array() : above;
    above.push_back(node);
    return node;
}

void NodeWriter::set(int node, const Transform& transform) {
    Json& json = at(node);
    json.erase("matrix");
    glm::dvec3 t(transform.translation);
    t += parent(node) < 0 ? origin_ : glm::dvec3(0.0);
    t /= metres_per_unit_;
    const glm::quat& q = transform.rotation;
    json["translation"] = {t.x, t.y, t.z};
    json["rotation"] = {q.x, q.y, q.z, q.w};
    json["scale"] = {transform.scale.x, transform.scale.y, transform.scale.z};
}

void NodeWriter::set(int node, const glm::dmat4& parent_from_node) {
    Json& json = at(node);
    for (const char* key : {"translation", "rotation", "scale"}) {
        json.erase(key);
    }
    glm::dmat4 m = parent_from_node;
    m[3] = glm::dvec4(glm::dvec3(m[3]) / metres_per_unit_, 1.0);
    Json values = Json::array();
    for (int i = 0; i < 16; ++i) {
        values.push_back(i % 4 == 3 ? (i == 15 ? 1.0 : 0.0) : m[i / 4][i % 4]);
    }
    json["matrix"] = std::move(values);
}

void NodeWriter::set_world(int node, const glm::dmat4& world_from_node) {
    set(node, glm::inverse(this->world_from_node(parent(node))) * world_from_node);
}

bool NodeWriter::is_at(int node, const Transform& transform) const {
    glm::dmat4 here = local(index(node));
    here[3] -= parent(node) < 0 ? glm::dvec4(origin_, 0.0) : glm::dvec4(0.0);
    return nearly(here, glm::dmat4(transform.matrix()));
}

std::vector<int> NodeWriter::subtree(int root, const std::vector<bool>& others) {
    std::vector<int> found{root};
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (const Json& child : array_or_empty(at(found[i]), "children")) {
            const int node = child.get<int>();
            if (index(node) >= others.size() || !others[index(node)]) {
                found.push_back(node);
            }
        }
    }
    return found;
}

}  // namespace raybundle
