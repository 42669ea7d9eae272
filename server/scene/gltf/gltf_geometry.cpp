// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/gltf/file/gltf_accessor.h"
#include "scene/gltf/gltf_skin.h"

namespace raybundle {
namespace {

constexpr std::size_t max_scene_vertices = 25'000'000;
// As many as TessellationSettings::max_patches: more could never be used.
constexpr std::size_t max_scene_triangles = 4'000'000;
// Derived: so many boxes of 12 triangles have as many as there may be.
constexpr std::size_t max_scene_instances = max_scene_triangles / 12;

/// An attribute of EXT_mesh_gpu_instancing; empty if absent.
std::vector<float> read_instance_attribute(const GltfDocument& document,
                                           const tinygltf::Value& attributes, const char* name,
                                           std::size_t components, const std::string& path) {
    const int accessor = integer_or(attributes, name, -1);
    return accessor < 0
               ? std::vector<float>{}
               : read_floats(document, accessor, components, fmt::format("{}.{}", path, name));
}

std::vector<glm::dmat4> read_instances(const GltfDocument& document, int node,
                                       float metres_per_unit) {
    const auto* extension =
        find_extension(item(document.model().nodes, node).extensions, "EXT_mesh_gpu_instancing");
    if (extension == nullptr || !extension->Has("attributes")) {
        return {glm::dmat4(1.0)};
    }
    const tinygltf::Value& attributes = extension->Get("attributes");
    const std::string path =
        item_path("nodes", node) + ".extensions.EXT_mesh_gpu_instancing.attributes";
    const auto t = read_instance_attribute(document, attributes, "TRANSLATION", 3, path);
    const auto r = read_instance_attribute(document, attributes, "ROTATION", 4, path);
    const auto s = read_instance_attribute(document, attributes, "SCALE", 3, path);
    const std::size_t count = std::max({t.size() / 3, r.size() / 4, s.size() / 3});
    if ((!t.empty() && t.size() != count * 3) || (!r.empty() && r.size() != count * 4) ||
        (!s.empty() && s.size() != count * 3)) {
        document.fail(path, "TRANSLATION, ROTATION and SCALE differ in length");
    }
    if (count > max_scene_instances) {
        document.fail(path,
                      fmt::format("{} instances; the limit is {}", count, max_scene_instances));
    }
    std::vector<glm::dmat4> instances;
    for (std::size_t i = 0; i < count; ++i) {
        Transform transform;
        if (!t.empty()) {
            transform.translation =
                glm::vec3(t[i * 3], t[i * 3 + 1], t[i * 3 + 2]) * metres_per_unit;
        }
        if (!r.empty()) {
            const glm::quat rotation(r[i * 4 + 3], r[i * 4], r[i * 4 + 1], r[i * 4 + 2]);
            if (glm::dot(rotation, rotation) > 1e-6F) {
                transform.rotation = glm::normalize(rotation);
            }
        }
        if (!s.empty()) {
            transform.scale = glm::vec3(s[i * 3], s[i * 3 + 1], s[i * 3 + 2]);
        }
        instances.emplace_back(transform.matrix());
    }
    return instances;
}

Bounds transformed(const Bounds& bounds, const glm::dmat4& matrix) {
    Bounds result;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1U) != 0 ? bounds.max.x : bounds.min.x,
                               (corner & 2U) != 0 ? bounds.max.y : bounds.min.y,
                               (corner & 4U) != 0 ? bounds.max.z : bounds.min.z);
        result.add(glm::vec3(matrix * glm::dvec4(point, 1.0)));
    }
    return result;
}

Bounds find_world_bounds(const NodeGeometry& geometry, const GltfNode& node) {
    const Bounds local = geometry.local_bounds();
    Bounds world;
    if (local.empty()) {
        return world;
    }
    for (const glm::dmat4& node_from_mesh : geometry.node_from_mesh) {
        const glm::dmat4 matrix =
            geometry.in_world ? glm::dmat4(1.0) : node.world_from_node * node_from_mesh;
        const Bounds instance = transformed(local, matrix);
        world.add(instance.min);
        world.add(instance.max);
    }
    return world;
}

/// Reads node by node and stops as soon as a limit is passed, before memory runs out.
class GeometryReader {
  public:
    GeometryReader(GltfDocument& document, const GltfNodeTree& tree, float metres_per_unit)
        : document_(document), tree_(tree), metres_per_unit_(metres_per_unit) {}

    NodeGeometry read(int node) {
        const tinygltf::Node& source = item(document_.model().nodes, node);
        NodeGeometry geometry;
        geometry.node = node;
        geometry.mesh = source.mesh;
        geometry.node_from_mesh = read_instances(document_, node, metres_per_unit_);
        count_instances(geometry.node_from_mesh.size(), node);
        read_primitives(source, geometry);
        if (source.skin >= 0) {
            geometry.in_world =
                apply_skin(document_, tree_, source.skin, node, metres_per_unit_, geometry);
        }
        geometry.world_bounds = find_world_bounds(geometry, item(tree_.nodes, node));
        return geometry;
    }

  private:
    void read_primitives(const tinygltf::Node& node, NodeGeometry& geometry) {
        const tinygltf::Mesh& mesh = item(document_.model().meshes, geometry.mesh);
        const std::string mesh_path = item_path("meshes", geometry.mesh);
        const std::vector<float> morph_weights = read_morph_weights(node, mesh);
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            const std::string path =
                mesh_path + "." + item_path("primitives", geometry.primitives.size());
            expect(primitive, geometry.node_from_mesh.size(), path);
            PrimitiveData& data = geometry.primitives.emplace_back(
                read_primitive(document_, primitive, morph_weights, path));
            count(data, geometry.node_from_mesh.size(), path);
            for (glm::vec3& position : data.positions) {
                position *= metres_per_unit_;
            }
        }
    }

    /// Of nodes with EXT_mesh_gpu_instancing and those without, which are one each.
    void count_instances(std::size_t instances, int node) {
        instances_ += instances;
        if (instances_ > max_scene_instances) {
            document_.fail(item_path("nodes", node), fmt::format("the scene has more than {} "
                                                                 "instances of meshes",
                                                                 max_scene_instances));
        }
    }

    /// Refuses what count() would, before it takes memory.
    void expect(const tinygltf::Primitive& primitive, std::size_t instances,
                const std::string& path) const {
        const auto positions = primitive.attributes.find("POSITION");
        if (positions != primitive.attributes.end()) {
            const std::size_t vertices =
                item(document_.model().accessors, positions->second).count * instances;
            check_sums(vertices_ + vertices, triangles_, path);
        }
    }

    void count(const PrimitiveData& data, std::size_t instances, const std::string& path) {
        vertices_ += data.positions.size() * instances;
        triangles_ += data.triangles.size() * instances;
        check_sums(vertices_, triangles_, path);
    }

    void check_sums(std::size_t vertices, std::size_t triangles, const std::string& path) const {
        if (vertices > max_scene_vertices || triangles > max_scene_triangles) {
            document_.fail(path, fmt::format("the scene has more than {} vertices or {} triangles",
                                             max_scene_vertices, max_scene_triangles));
        }
    }

    GltfDocument& document_;
    const GltfNodeTree& tree_;
    float metres_per_unit_;
    std::size_t vertices_ = 0;
    std::size_t triangles_ = 0;
    std::size_t instances_ = 0;
};

}  // namespace

std::vector<float> read_morph_weights(const tinygltf::Node& node, const tinygltf::Mesh& mesh) {
    const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
    return {weights.begin(), weights.end()};
}

std::size_t NodeGeometry::triangle_count() const {
    std::size_t count = 0;
    for (const PrimitiveData& primitive : primitives) {
        count += primitive.triangles.size();
    }
    return count * node_from_mesh.size();
}

Bounds NodeGeometry::local_bounds() const {
    Bounds local;
    for (const PrimitiveData& primitive : primitives) {
        for (const glm::uvec3& triangle : primitive.triangles) {
            for (int k = 0; k < 3; ++k) {
                local.add(primitive.positions[triangle[k]]);
            }
        }
    }
    return local;
}

std::vector<NodeGeometry> read_geometry(GltfDocument& document, const GltfNodeTree& tree,
                                        float metres_per_unit) {
    std::vector<NodeGeometry> geometries;
    GeometryReader reader(document, tree, metres_per_unit);
    for (const int node : tree.order) {
        if (item(document.model().nodes, node).mesh < 0) {
            continue;
        }
        if (!item(tree.nodes, node).visible) {
            document.note("hidden nodes (KHR_node_visibility) are left out");
            continue;
        }
        NodeGeometry geometry = reader.read(node);
        if (geometry.triangle_count() > 0) {
            geometries.push_back(std::move(geometry));
        }
    }
    if (geometries.empty()) {
        document.fail("", "the scene has no triangles");
    }
    return geometries;
}

}  // namespace raybundle
