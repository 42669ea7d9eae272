// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/animation/animation_links.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <unordered_map>

#include "scene/gltf/animation/shape_links.h"

namespace raybundle {
namespace {

bool same(const Transform& a, const Transform& b) {
    return a.translation == b.translation && a.rotation == b.rotation && a.scale == b.scale;
}

template <typename T>
void sort_once(std::vector<T>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

class Linker {
  public:
    Linker(GltfDocument& document, const FileAnimations& file, const NodeUses& uses, Scene& scene)
        : document_(document),
          file_(file),
          uses_(uses),
          scene_(scene),
          shape_links_(document, uses.tree, uses.geometries, uses.metres_per_unit,
                       [this](int node) {
                           const auto n = static_cast<std::size_t>(node);
                           return carried_[n] ? animated_node(n) : ShapeJoint::none;
                       }) {}

    void link() {
        result_.tracks = file_.tracks;
        result_.metres_per_unit = uses_.metres_per_unit;
        carried_ = carried_nodes(uses_.tree, file_);
        add_objects();
        add_lights();
        shape_links_.add(uses_.baked, file_.morphed, result_);
        find_shape_objects();
        note_idle_nodes();
        result_.file_emissions.resize(scene_.materials.size());
        for (std::size_t m = 0; m < document_.model().materials.size(); ++m) {
            if (m < scene_.materials.size()) {
                result_.file_emissions[m] = emission(document_.model().materials[m]);
            }
        }
        for (const FileAnimation& animation : file_.animations) {
            add(animation);
        }
        if (!result_.animations.empty()) {
            scene_.animations = std::make_shared<const SceneAnimations>(std::move(result_));
        }
    }

  private:
    [[nodiscard]] const GltfNode& node(std::size_t index) const { return uses_.tree.nodes[index]; }

    void add_objects() {
        for (std::size_t i = 0; i < uses_.plans.size(); ++i) {
            const ObjectPlan& plan = uses_.plans[i];
            const auto n = static_cast<std::size_t>(plan.node);
            const Object& object = scene_.objects[i];
            const bool skinned =
                std::any_of(plan.geometries.begin(), plan.geometries.end(),
                            [this](std::size_t g) { return uses_.geometries[g].in_world; });
            if (!carried_[n] || skinned ||
                glm::determinant(glm::dmat4(object.world_from_parent)) == 0.0) {
                continue;
            }
            result_.objects.push_back({animated_node(n), static_cast<std::uint32_t>(i),
                                       same(object.transform, node(n).transform)});
        }
    }

    void add_lights() {
        for (std::size_t i = 0; i < uses_.sources.size(); ++i) {
            const LightSource& source = uses_.sources[i];
            result_.file_lights.push_back({source.intensity, source.colour});
            const bool free = scene_.punctual_lights[i].object == PunctualLight::no_object;
            if (carried_[source.node] && free) {
                result_.lights.push_back(
                    {animated_node(source.node), static_cast<std::uint32_t>(i), false});
            }
        }
    }

    /// Index into SceneAnimations::nodes of a carried node, after those above it.
    std::size_t animated_node(std::size_t index) {
        std::vector<std::size_t> chain;
        std::size_t highest = 0;  // of those in the chain that an animation moves, plus one
        std::size_t parent = AnimatedNode::no_parent;
        for (int at = static_cast<int>(index); at >= 0;
             at = node(static_cast<std::size_t>(at)).parent) {
            const auto n = static_cast<std::size_t>(at);
            if (const auto known = indices_.find(n); known != indices_.end()) {
                parent = known->second;
                highest = chain.size();
                break;
            }
            chain.push_back(n);
            highest = file_.moved[n] ? chain.size() : highest;
        }
        chain.resize(highest);
        for (auto n = chain.rbegin(); n != chain.rend(); ++n) {
            add_node(*n, parent);
            parent = result_.nodes.size() - 1;
        }
        return parent;
    }

    void add_node(std::size_t index, std::size_t parent) {
        const GltfNode& source = node(index);
        AnimatedNode result;
        result.parent = parent;
        if (parent == AnimatedNode::no_parent && source.parent >= 0) {
            result.world_from_parent =
                node(static_cast<std::size_t>(source.parent)).world_from_node;
        }
        result.rest = source.transform;
        result.parent_from_node = source.parent_from_node;
        result.parent_from_object = glm::dmat4(source.transform.matrix());
        if (glm::dvec3(source.remainder[3]) == glm::dvec3(0.0)) {
            result.parent_from_object[3] = source.parent_from_node[3];
        }
        result.offset = source.parent < 0 ? scene_.origin : glm::dvec3(0.0);
        indices_[index] = result_.nodes.size();
        result_.nodes.push_back(result);
    }

    /// Parts of a lone object have become objects since their vertices were made.
    void find_shape_objects() {
        constexpr std::uint32_t none = 0xffffffffU;
        std::vector<std::uint32_t> shape_of(result_.shapes.empty() ? 0 : scene_.vertices.size(),
                                            none);
        for (std::size_t s = 0; s < result_.shapes.size(); ++s) {
            const DeformingShape& shape = result_.shapes[s];
            std::fill_n(shape_of.begin() + shape.first_vertex, shape.from.size(),
                        static_cast<std::uint32_t>(s));
        }
        shape_objects_.resize(result_.shapes.size());
        for (const Triangle& triangle : scene_.triangles) {
            const std::uint32_t shape = shape_of.empty() ? none : shape_of[triangle.vertex[0]];
            if (shape != none && (shape_objects_[shape].empty() ||
                                  shape_objects_[shape].back() != triangle.object)) {
                shape_objects_[shape].push_back(triangle.object);
            }
        }
    }

    /// Cameras, parts of what moves as a whole.
    void note_idle_nodes() {
        std::string names;
        std::size_t count = 0;
        for (std::size_t n = 0; n < file_.moved.size(); ++n) {
            if (!file_.moved[n] || indices_.contains(n)) {
                continue;
            }
            constexpr std::size_t most_named = 5;
            if (++count <= most_named) {
                const std::string name =
                    node(n).name.empty() ? item_path("nodes", n) : "'" + node(n).name + "'";
                names += (names.empty() ? "" : ", ") + name;
            }
        }
        if (count > 0) {
            document_.note(
                fmt::format("{} animated nodes move nothing by themselves ("
                            "cameras, parts of what moves as a whole): {}",
                            count, names));
        }
    }

    static FileEmission emission(const tinygltf::Material& material) {
        FileEmission result;
        result.factor = vector_or(material.emissiveFactor, glm::vec3(0.0F));
        if (const auto* extension =
                find_extension(material.extensions, "KHR_materials_emissive_strength")) {
            result.strength = number_or(*extension, "emissiveStrength", 1.0F);
        }
        return result;
    }

    void add(const FileAnimation& source) {
        Animation animation;
        animation.name = source.name;
        animation.seconds = source.seconds;
        for (const FileChannel& channel : source.channels) {
            if (channel.value <= AnimatedValue::scale) {
                add_node_channel(channel, animation);
            } else if (channel.value == AnimatedValue::morph_weights) {
                add_morph_channel(channel, animation);
            } else if (channel.value <= AnimatedValue::outer_cone) {
                add_light_channel(channel, animation);
            } else {
                add_material_channel(channel, animation);
            }
        }
        find_carried(animation);
        sort_once(animation.shapes);
        sort_once(animation.objects);
        sort_once(animation.lights);
        sort_once(animation.materials);
        if (only_deforms(animation) && animation.shapes.empty()) {
            document_.note(
                fmt::format("animation '{}' moves nothing that can be moved: it is "
                            "left out",
                            animation.name));
            return;
        }
        if (!animation.shapes.empty()) {
            document_.note(
                fmt::format("animation '{}' deforms objects: render --script shows it, "
                            "to viewers of a server they keep their rest pose",
                            animation.name));
        }
        result_.animations.push_back(std::move(animation));
    }

    void add_node_channel(const FileChannel& channel, Animation& animation) {
        const auto known = indices_.find(channel.target);
        if (known != indices_.end()) {
            animation.channels.push_back({channel.value, known->second, channel.track});
        }
    }

    void add_morph_channel(const FileChannel& channel, Animation& animation) {
        const std::size_t morph = shape_links_.morph_of(channel.target);
        if (morph == DeformingShape::none) {
            return;
        }
        animation.weights.push_back({channel.value, morph, channel.track});
        for (std::size_t s = 0; s < result_.shapes.size(); ++s) {
            if (result_.shapes[s].morph == morph) {
                add_shape(s, animation);
            }
        }
    }

    void add_shape(std::size_t shape, Animation& animation) const {
        const std::vector<std::uint32_t>& objects = shape_objects_[shape];
        animation.shapes.insert(animation.shapes.end(), objects.begin(), objects.end());
    }

    [[nodiscard]] std::uint32_t number_of(std::size_t punctual) const {
        return static_cast<std::uint32_t>(scene_.lights.size() + punctual + 1);
    }

    /// Of all nodes that have that light.
    void add_light_channel(const FileChannel& channel, Animation& animation) {
        const bool cone = channel.value >= AnimatedValue::inner_cone;
        for (std::size_t i = 0; i < uses_.sources.size(); ++i) {
            const PunctualLight& light = scene_.punctual_lights[i];
            const bool fits = !light.profile && (!cone || light.kind == PunctualKind::spot);
            if (uses_.sources[i].definition == channel.target && fits) {
                animation.channels.push_back({channel.value, i, channel.track});
                animation.lights.push_back(number_of(i));
            }
        }
    }

    void add_material_channel(const FileChannel& channel, Animation& animation) {
        const std::size_t m = channel.target;
        if (m >= scene_.materials.size()) {
            return;
        }
        if (channel.value < AnimatedValue::emissive_factor) {
            animation.channels.push_back({channel.value, m, channel.track});
            animation.materials.push_back(static_cast<std::uint32_t>(m + 1));
            return;
        }
        const auto light =
            std::find_if(scene_.lights.begin(), scene_.lights.end(),
                         [m](const Light& l) { return l.material == static_cast<int>(m); });
        if (light == scene_.lights.end()) {
            document_.note(
                fmt::format("animated, but left as it is: the emission of '{}', which "
                            "is no light in the file",
                            scene_.materials[m].name));
            return;
        }
        animation.channels.push_back({channel.value, m, channel.track});
        animation.lights.push_back(light->id);
    }

    /// What goes with the nodes that it moves.
    void find_carried(Animation& animation) {
        std::vector<bool> moved(result_.nodes.size());
        for (const AnimationChannel& channel : animation.channels) {
            if (channel.value <= AnimatedValue::scale) {
                moved[channel.target] = true;
            }
        }
        for (std::size_t n = 0; n < moved.size(); ++n) {
            const std::size_t parent = result_.nodes[n].parent;
            moved[n] = moved[n] || (parent != AnimatedNode::no_parent && moved[parent]);
        }
        for (const CarriedByNode& object : result_.objects) {
            if (moved[object.node]) {
                animation.objects.push_back(object.item);
            }
        }
        for (const CarriedByNode& light : result_.lights) {
            if (moved[light.node]) {
                animation.lights.push_back(number_of(light.item));
            }
        }
        for (std::size_t s = 0; s < result_.shapes.size(); ++s) {
            const std::size_t skin = result_.shapes[s].skin;
            if (skin != DeformingShape::none && moves_any(moved, result_.skins[skin])) {
                add_shape(s, animation);
            }
        }
    }

    static bool moves_any(const std::vector<bool>& moved, const ShapeSkin& skin) {
        const auto is_moved = [&moved](const ShapeJoint& joint) {
            return joint.node != ShapeJoint::none && moved[joint.node];
        };
        return std::any_of(skin.joints.begin(), skin.joints.end(), is_moved) || is_moved(skin.own);
    }

    GltfDocument& document_;
    const FileAnimations& file_;
    const NodeUses& uses_;
    Scene& scene_;
    SceneAnimations result_;
    ShapeLinks shape_links_;
    std::vector<std::vector<std::uint32_t>> shape_objects_;  // of each of SceneAnimations::shapes
    std::vector<bool> carried_;                              // of each node of the file
    std::unordered_map<std::size_t, std::size_t> indices_;   // into nodes, by node of the file
};

}  // namespace

void link_animations(GltfDocument& document, const FileAnimations& file, const NodeUses& uses,
                     Scene& scene) {
    if (!file.animations.empty()) {
        Linker(document, file, uses, scene).link();
    }
}

}  // namespace raybundle
