// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_bake.h"

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

#include "scene/mesh/baked_vertex.h"
#include "scene/mesh/geometry_defects.h"
#include "scene/neighbourhood.h"

namespace raybundle {
namespace {

// A light-second is 3e8 m; beyond this fp32 areas overflow.
constexpr double max_coordinate = 1e9;

class Baker {
  public:
    Baker(GltfDocument& document, const GltfNodeTree& tree,
          const std::vector<NodeGeometry>& geometries, std::uint32_t default_material,
          const std::vector<bool>& followed, Scene& scene)
        : document_(document),
          tree_(tree),
          default_material_(default_material),
          followed_(followed),
          scene_(scene) {
        Bounds all;
        for (const NodeGeometry& geometry : geometries) {
            all.add(geometry.world_bounds.min);
            all.add(geometry.world_bounds.max);
        }
        tie_ = coincidence_share * double{glm::length(all.extent())};
    }

    /// False: it has no triangle with an area.
    bool add_object(const ObjectPlan& plan, const std::vector<NodeGeometry>& geometries) {
        const std::size_t first_triangle = scene_.triangles.size();
        begin_object(plan);
        for (const std::size_t geometry : plan.geometries) {
            add_geometry(geometries[geometry], geometry);
        }
        if (scene_.triangles.size() == first_triangle) {
            return false;
        }
        finish_object(first_triangle);
        return true;
    }

    void add_notices() const {
        if (scene_.removed.degenerate_triangles > 0) {
            document_.note(fmt::format("{} triangles without area are left out",
                                       scene_.removed.degenerate_triangles));
        }
        if (bad_normals_ > 0) {
            document_.note(
                fmt::format("{} vertices have a normal of length zero: the normal of "
                            "their face is used",
                            bad_normals_));
        }
    }

    std::vector<BakedPrimitive> take_baked() { return std::move(baked_); }

  private:
    [[nodiscard]] const GltfNode& node(int index) const {
        return tree_.nodes[static_cast<std::size_t>(index)];
    }

    void begin_object(const ObjectPlan& plan) {
        object_ = {};
        object_.id = static_cast<std::uint32_t>(scene_.objects.size() + 1);
        object_.name = plan.name;
        object_.movable = plan.movable;
        object_.kind = plan.kind;
        object_.path = plan.path;
        object_.node = plan.node;
        object_.transform = node(plan.node).transform;
        const int parent = node(plan.node).parent;
        if (parent >= 0) {
            object_.world_from_parent = glm::mat4(node(parent).world_from_node);
        }
        keep_place(plan.node);
        world_from_object_ = glm::dmat4(object_.world_from_object());
        object_from_node_ = {{plan.node, node(plan.node).remainder}};
    }

    /// Where large offsets of a node and its ancestors cancel, single precision would lose their
    /// sum: the object gets its place as a whole.
    void keep_place(int index) {
        const GltfNode& own = node(index);
        if (glm::dvec3(own.remainder[3]) != glm::dvec3(0.0)) {
            return;  // vertices carry all of it
        }
        glm::dmat4 place(object_.transform.matrix());
        place[3] = own.parent_from_node[3];
        if (own.parent >= 0) {
            place = node(own.parent).world_from_node * place;
        }
        const glm::dvec3 lost(place[3] - glm::dvec4(object_.world_from_object()[3]));
        if (glm::length(lost) > tie_) {
            object_.transform = {};
            object_.world_from_parent = glm::mat4(place);
        }
    }

    void add_geometry(const NodeGeometry& geometry, std::size_t index) {
        for (const glm::dmat4& node_from_mesh : geometry.node_from_mesh) {
            const glm::dmat4 object_from_mesh =
                geometry.in_world ? object_from_world()
                                  : object_from_node(geometry.node) * node_from_mesh;
            for (std::size_t i = 0; i < geometry.primitives.size(); ++i) {
                path_ =
                    fmt::format("meshes[{}].primitives[{}].attributes.POSITION", geometry.mesh, i);
                sources_.clear();
                const auto first = static_cast<std::uint32_t>(scene_.vertices.size());
                add_primitive(geometry.primitives[i], object_from_mesh);
                if (followed_[index] && scene_.vertices.size() > first) {
                    baked_.push_back({index, i, first, sources_, object_from_mesh});
                }
            }
        }
    }

    /// Remembers the nodes in between, so that long chains are climbed once.
    glm::dmat4 object_from_node(int from) {
        std::vector<int> climbed;
        int at = from;
        for (; !object_from_node_.contains(at); at = node(at).parent) {
            climbed.push_back(at);
        }
        glm::dmat4 matrix = object_from_node_.at(at);
        for (auto it = climbed.rbegin(); it != climbed.rend(); ++it) {
            matrix = matrix * node(*it).parent_from_node;
            object_from_node_[*it] = matrix;
        }
        return matrix;
    }

    /// For skinned vertices. An object scaled to nothing cannot hold them: it is put at the origin.
    glm::dmat4 object_from_world() {
        if (glm::determinant(world_from_object_) == 0.0) {
            object_.transform = {};
            object_.world_from_parent = glm::mat4(1.0F);
            world_from_object_ = glm::dmat4(1.0);
        }
        return glm::inverse(world_from_object_);
    }

    void add_primitive(const PrimitiveData& data, const glm::dmat4& object_from_mesh) {
        if (data.triangles.empty()) {
            return;
        }
        const auto first = static_cast<std::uint32_t>(scene_.vertices.size());
        const bool flat = data.normals.empty();
        add_vertices(data, object_from_mesh);
        const bool mirrored =
            glm::determinant(glm::dmat3(world_from_object_ * object_from_mesh)) < 0.0;
        for (const glm::uvec3& corners : data.triangles) {
            Triangle triangle;
            triangle.material =
                data.material < 0 ? default_material_ : static_cast<std::uint32_t>(data.material);
            triangle.object = object_.id - 1;
            for (int k = 0; k < 3; ++k) {
                triangle.vertex[k] = first + corners[mirrored ? 2 - k : k];
            }
            add_triangle(triangle, flat);
        }
    }

    void add_vertices(const PrimitiveData& data, const glm::dmat4& object_from_mesh) {
        const glm::dmat3 normals = normal_matrix(object_from_mesh);
        for (std::size_t v = 0; v < data.positions.size(); ++v) {
            Vertex vertex;
            vertex.position =
                glm::vec3(object_from_mesh * glm::dvec4(glm::dvec3(data.positions[v]), 1.0));
            if (!data.normals.empty()) {
                vertex.normal = unit_or_zero(normals * glm::dvec3(data.normals[v]));
            }
            if (!data.uvs.empty()) {
                vertex.uv = data.uvs[v];
            }
            if (!data.colours.empty()) {
                vertex.colour = data.colours[v];
            }
            scene_.vertices.push_back(vertex);
            sources_.push_back(static_cast<std::uint32_t>(v));
        }
    }

    void add_triangle(Triangle triangle, bool flat) {
        glm::dvec3 object_points[3];
        glm::dvec3 world_points[3];
        for (int k = 0; k < 3; ++k) {
            object_points[k] = scene_.vertices[triangle.vertex[k]].position;
            world_points[k] = glm::dvec3(world_from_object_ * glm::dvec4(object_points[k], 1.0));
            check_range(world_points[k]);
        }
        if (is_degenerate(world_points[0], world_points[1], world_points[2])) {
            ++scene_.removed.degenerate_triangles;
            return;
        }
        // The front is defined in world space; in a mirrored object it looks the other way round.
        const double side = glm::determinant(glm::dmat3(world_from_object_)) < 0.0 ? -1.0 : 1.0;
        const glm::vec3 face_normal =
            unit_or_zero(side * glm::cross(object_points[1] - object_points[0],
                                           object_points[2] - object_points[0]));
        for (std::uint32_t& index : triangle.vertex) {
            if (flat) {
                sources_.push_back(
                    std::uint32_t{sources_[index - (scene_.vertices.size() - sources_.size())]});
                scene_.vertices.push_back(scene_.vertices[index]);
                index = static_cast<std::uint32_t>(scene_.vertices.size() - 1);
                scene_.vertices.back().normal = face_normal;
            } else if (scene_.vertices[index].normal == glm::vec3(0.0F)) {
                scene_.vertices[index].normal = face_normal;
                ++bad_normals_;
            }
        }
        scene_.triangles.push_back(triangle);
    }

    void check_range(const glm::dvec3& world) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(world[axis]) <= max_coordinate)) {
                document_.fail(path_, fmt::format("a vertex is at {} m; the limit is {} m",
                                                  world[axis], max_coordinate));
            }
        }
    }

    void finish_object(std::size_t first_triangle) {
        for (std::size_t t = first_triangle; t < scene_.triangles.size(); ++t) {
            for (const std::uint32_t index : scene_.triangles[t].vertex) {
                const glm::vec3& position = scene_.vertices[index].position;
                object_.bounds.add(position);
                scene_.bounds.add(
                    glm::vec3(world_from_object_ * glm::dvec4(glm::dvec3(position), 1.0)));
            }
        }
        scene_.objects.push_back(object_);
    }

    GltfDocument& document_;
    const GltfNodeTree& tree_;
    std::uint32_t default_material_;
    const std::vector<bool>& followed_;
    std::vector<BakedPrimitive> baked_;
    std::vector<std::uint32_t> sources_;  // of the present primitive's vertices
    Scene& scene_;
    Object object_;
    glm::dmat4 world_from_object_{1.0};
    std::unordered_map<int, glm::dmat4> object_from_node_;
    std::string path_;
    std::size_t bad_normals_ = 0;
    double tie_ = 0.0;  // m: closer surfaces coincide
};

}  // namespace

std::vector<BakedPrimitive> bake_objects(GltfDocument& document, const GltfNodeTree& tree,
                                         const std::vector<NodeGeometry>& geometries,
                                         std::vector<ObjectPlan>& plans,
                                         std::uint32_t default_material,
                                         const std::vector<bool>& followed, Scene& scene) {
    Baker baker(document, tree, geometries, default_material, followed, scene);
    std::erase_if(plans, [&](const ObjectPlan& plan) {
        return !baker.add_object(plan, geometries);  // each once, in order
    });
    baker.add_notices();
    if (scene.triangles.empty()) {
        document.fail("", "the scene has no triangles with an area");
    }
    return baker.take_baked();
}

}  // namespace raybundle
