// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/animation/shape_links.h"

#include <fmt/format.h>

#include "scene/gltf/gltf_skin.h"

namespace raybundle {
namespace {

// A sparse accessor may stand for many; as many as 200 MB of places and normals.
constexpr std::size_t most_offsets = 8'000'000;

}  // namespace

std::vector<bool> find_deforming(const GltfDocument& document, const GltfNodeTree& tree,
                                 const std::vector<NodeGeometry>& geometries,
                                 const FileAnimations& animations) {
    const std::vector<bool> carried = carried_nodes(tree, animations);
    std::vector<bool> deforming;
    for (const NodeGeometry& geometry : geometries) {
        bool any = animations.morphed[static_cast<std::size_t>(geometry.node)];
        if (geometry.in_world) {
            const int skin = item(document.model().nodes, geometry.node).skin;
            for (const int joint : item(document.model().skins, skin).joints) {
                any = any || carried[static_cast<std::size_t>(joint)];
            }
        }
        deforming.push_back(any);
    }
    return deforming;
}

void ShapeLinks::add(const std::vector<BakedPrimitive>& baked, const std::vector<bool>& morphed,
                     SceneAnimations& result) {
    for (const BakedPrimitive& part : baked) {
        const NodeGeometry& geometry = geometries_[part.geometry];
        DeformingShape shape;
        shape.rest = rest_of(geometry.mesh, part.primitive, result);
        if (shape.rest == DeformingShape::none) {
            continue;
        }
        shape.skin = geometry.in_world ? skin_of(geometry.node, result) : DeformingShape::none;
        if (!result.rests[shape.rest].targets.empty()) {
            add_morph(geometry.node, result);
            shape.morph = morphs_.at(geometry.node);
        } else if (morphed[static_cast<std::size_t>(geometry.node)] &&
                   shape.skin == DeformingShape::none) {
            continue;  // it has nothing to be morphed to
        }
        shape.first_vertex = part.first_vertex;
        shape.from = part.from;
        shape.object_from_mesh = part.object_from_mesh;
        result.shapes.push_back(std::move(shape));
    }
}

std::size_t ShapeLinks::morph_of(std::size_t node) const {
    const auto known = morphs_.find(static_cast<int>(node));
    return known == morphs_.end() ? DeformingShape::none : known->second;
}

std::size_t ShapeLinks::rest_of(int mesh, std::size_t primitive, SceneAnimations& result) {
    const auto known = rests_.find({mesh, primitive});
    if (known != rests_.end()) {
        return known->second;
    }
    const tinygltf::Primitive& source = item(document_.model().meshes, mesh).primitives[primitive];
    const std::string path = item_path("meshes", mesh) + "." + item_path("primitives", primitive);
    PrimitiveData data = read_primitive(document_, source, {}, path);
    offsets_ += data.positions.size() * source.targets.size();
    if (offsets_ > most_offsets) {
        document_.note(
            fmt::format("{}: more than {} offsets of morph targets in all: it keeps the "
                        "shape that it has at first",
                        path, most_offsets));
        return rests_[{mesh, primitive}] = DeformingShape::none;
    }
    RestShape& rest = result.rests.emplace_back();
    rest.targets = read_morph_targets(document_, source, path, data);
    rest.positions = std::move(data.positions);
    rest.normals = std::move(data.normals);
    rest.joints = std::move(data.joints);
    rest.weights = std::move(data.weights);
    return rests_[{mesh, primitive}] = result.rests.size() - 1;
}

std::size_t ShapeLinks::skin_of(int node, SceneAnimations& result) {
    const auto known = skins_.find(node);
    if (known != skins_.end()) {
        return known->second;
    }
    const int skin = item(document_.model().nodes, node).skin;
    const std::vector<glm::dmat4> binds = read_joint_binds(document_, skin, metres_per_unit_);
    const auto joint_at = [this](int at, const glm::dmat4& from_bind) {
        return ShapeJoint{find_node_(at), item(tree_.nodes, at).world_from_node, from_bind};
    };
    ShapeSkin shape;
    shape.own = joint_at(node, glm::dmat4(1.0));
    for (std::size_t j = 0; j < binds.size(); ++j) {
        shape.joints.push_back(joint_at(item(document_.model().skins, skin).joints[j], binds[j]));
    }
    result.skins.push_back(std::move(shape));
    return skins_[node] = result.skins.size() - 1;
}

void ShapeLinks::add_morph(int node, SceneAnimations& result) {
    if (!morphs_.contains(node)) {
        const tinygltf::Node& source = item(document_.model().nodes, node);
        const tinygltf::Mesh& mesh = item(document_.model().meshes, source.mesh);
        std::vector<float> weights = read_morph_weights(source, mesh);
        weights.resize(mesh.primitives.front().targets.size());
        result.morph_weights.push_back(std::move(weights));
        morphs_[node] = result.morph_weights.size() - 1;
    }
}

}  // namespace raybundle
