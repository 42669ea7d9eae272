// SPDX-License-Identifier: Apache-2.0
#include "scene/animation/shape_pose.h"

#include <algorithm>

#include "scene/mesh/baked_vertex.h"

namespace raybundle {
namespace {

/// Where animations have what vertices follow.
class ShapePose {
  public:
    ShapePose(const SceneAnimations& all, std::span<const AnimationPlace> places)
        : all_(all), worlds_(node_worlds(all, places)), weights_(all.morph_weights) {
        for (const AnimationPlace& place : places) {
            for (const AnimationChannel& channel : all.animations[place.animation].weights) {
                std::vector<float>& weights = weights_[channel.target];
                for (std::size_t i = 0; i < weights.size(); ++i) {
                    weights[i] = all.tracks[channel.track].component_at(place.seconds, i);
                }
            }
        }
    }

    /// The vertices of the rest shape, in metres, in the mesh's space or, skinned, in the world.
    [[nodiscard]] RestShape deformed(const DeformingShape& shape) const {
        const RestShape& rest = all_.rests[shape.rest];
        RestShape result;
        result.positions = rest.positions;
        result.normals = rest.normals;
        if (shape.morph != DeformingShape::none) {
            add_targets(rest, weights_[shape.morph], result);
        }
        for (glm::vec3& position : result.positions) {
            position *= all_.metres_per_unit;
        }
        if (shape.skin != DeformingShape::none) {
            apply_skin(rest, all_.skins[shape.skin], result);
        }
        return result;
    }

  private:
    static void add_targets(const RestShape& rest, const std::vector<float>& weights,
                            RestShape& result) {
        for (std::size_t t = 0; t < std::min(weights.size(), rest.targets.size()); ++t) {
            if (weights[t] == 0.0F) {
                continue;
            }
            add_offsets(rest.targets[t].positions, weights[t], result.positions);
            add_offsets(rest.targets[t].normals, weights[t], result.normals);
        }
    }

    [[nodiscard]] const glm::dmat4& world(const ShapeJoint& joint) const {
        return joint.node == ShapeJoint::none ? joint.world : worlds_[joint.node];
    }

    void apply_skin(const RestShape& rest, const ShapeSkin& skin, RestShape& result) const {
        std::vector<glm::dmat4> joints;
        joints.reserve(skin.joints.size());
        for (const ShapeJoint& joint : skin.joints) {
            joints.push_back(world(joint) * joint.from_bind);
        }
        const glm::dmat4& otherwise = world(skin.own);
        for (std::size_t v = 0; v < result.positions.size(); ++v) {
            move_vertex(blended_joints(joints, rest.joints[v], rest.weights[v], otherwise),
                        result.positions[v], result.normals.empty() ? nullptr : &result.normals[v]);
        }
    }

    const SceneAnimations& all_;
    std::vector<glm::dmat4> worlds_;
    std::vector<std::vector<float>> weights_;
};

/// Vertices get the normal of their face where they have none of their own.
void add_face_normals(Scene& scene, const std::vector<bool>& deformed) {
    for (const Triangle& triangle : scene.triangles) {
        glm::dvec3 p[3];
        bool lacking = false;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = triangle.vertex[k];
            p[k] = scene.vertices[vertex].position;
            lacking =
                lacking || (deformed[vertex] && scene.vertices[vertex].normal == glm::vec3(0.0F));
        }
        if (!lacking) {
            continue;
        }
        // The front is defined in world space; in a mirrored object it looks the other way round.
        const glm::dmat3 world(scene.objects[triangle.object].placement());
        const double side = glm::determinant(world) < 0.0 ? -1.0 : 1.0;
        const glm::vec3 normal = unit_or_zero(side * glm::cross(p[1] - p[0], p[2] - p[0]));
        for (const std::uint32_t vertex : triangle.vertex) {
            if (deformed[vertex] && scene.vertices[vertex].normal == glm::vec3(0.0F)) {
                scene.vertices[vertex].normal = normal;
            }
        }
    }
}

void fit_bounds(Scene& scene, const std::vector<bool>& deformed) {
    std::vector<bool> fitted(scene.objects.size());
    for (const Triangle& triangle : scene.triangles) {
        fitted[triangle.object] = fitted[triangle.object] || deformed[triangle.vertex[0]];
    }
    for (std::size_t o = 0; o < fitted.size(); ++o) {
        if (fitted[o]) {
            scene.objects[o].bounds = {};
        }
    }
    for (const Triangle& triangle : scene.triangles) {
        Object& object = scene.objects[triangle.object];
        if (!fitted[triangle.object]) {
            continue;
        }
        const glm::dmat4 world(object.world_from_object());
        for (const std::uint32_t vertex : triangle.vertex) {
            const glm::vec3& position = scene.vertices[vertex].position;
            object.bounds.add(position);
            if (!object.removed) {
                scene.bounds.add(glm::vec3(world * glm::dvec4(glm::dvec3(position), 1.0)));
            }
        }
    }
}

}  // namespace

bool pose_shapes(Scene& scene, std::span<const AnimationPlace> places) {
    if (!scene.animations || scene.animations->shapes.empty()) {
        return false;
    }
    const SceneAnimations& all = *scene.animations;
    const ShapePose pose(all, places);
    std::vector<bool> deformed(scene.vertices.size());
    std::vector<std::pair<std::uint32_t, Vertex>> before;
    for (const DeformingShape& shape : all.shapes) {
        const RestShape now = pose.deformed(shape);
        const glm::dmat3 normals = normal_matrix(shape.object_from_mesh);
        for (std::size_t i = 0; i < shape.from.size(); ++i) {
            const std::uint32_t vertex = shape.first_vertex + static_cast<std::uint32_t>(i);
            const std::uint32_t from = shape.from[i];
            Vertex& target = scene.vertices[vertex];
            before.emplace_back(vertex, target);
            deformed[vertex] = true;
            target.position = glm::vec3(shape.object_from_mesh *
                                        glm::dvec4(glm::dvec3(now.positions[from]), 1.0));
            target.normal = now.normals.empty()
                                ? glm::vec3(0.0F)
                                : unit_or_zero(normals * glm::dvec3(now.normals[from]));
        }
    }
    add_face_normals(scene, deformed);
    const bool changed = std::any_of(before.begin(), before.end(), [&scene](const auto& old) {
        const Vertex& now = scene.vertices[old.first];
        return now.position != old.second.position || now.normal != old.second.normal;
    });
    if (changed) {
        fit_bounds(scene, deformed);
    }
    return changed;
}

}  // namespace raybundle
