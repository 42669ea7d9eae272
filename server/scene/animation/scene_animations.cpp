// SPDX-License-Identifier: Apache-2.0
#include "scene/animation/scene_animations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "scene/light/light_place.h"
#include "scene/object_limits.h"

namespace raybundle {
namespace {

// Below it nothing can be moved (protocol/README.md): what an animation scales to nothing.
constexpr float least_animated_scale = 1e-6F;

float with_size(float scale) {
    return std::abs(scale) < least_animated_scale ? std::copysign(least_animated_scale, scale)
                                                  : scale;
}

/// A unit vector across another one.
glm::dvec3 across(const glm::dvec3& x) {
    const glm::dvec3 other =
        std::abs(x.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(glm::cross(x, other));
}

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 1e-12 ? v / length : otherwise;
}

/// Translation, rotation and scale that come nearest; shear is left out.
Transform nearest_transform(const glm::dmat4& matrix) {
    const glm::dmat3 m(matrix);
    const double mirrored = glm::determinant(m) < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 x = unit_or(mirrored * m[0], glm::dvec3(1.0, 0.0, 0.0));
    const glm::dvec3 y = unit_or(m[1] - glm::dot(m[1], x) * x, across(x));
    Transform result;
    result.translation = glm::vec3(matrix[3]);
    result.rotation = glm::normalize(glm::quat(glm::quat_cast(glm::dmat3(x, y, glm::cross(x, y)))));
    result.scale = glm::vec3(with_size(static_cast<float>(mirrored * glm::length(m[0]))),
                             with_size(static_cast<float>(glm::length(m[1]))),
                             with_size(static_cast<float>(glm::length(m[2]))));
    return result;
}

/// Where an animation has a node. Far away single precision would round its place.
struct MovedNode {
    glm::dvec3 translation{0.0};  // m, with AnimatedNode::offset taken out
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 scale{1.0F};

    [[nodiscard]] Transform transform() const {
        return {glm::vec3(translation), rotation,
                glm::vec3(with_size(scale.x), with_size(scale.y), with_size(scale.z))};
    }
    [[nodiscard]] glm::dmat4 matrix() const {
        glm::dmat4 matrix(Transform{glm::vec3(0.0F), rotation, scale}.matrix());
        matrix[3] = glm::dvec4(translation, 1.0);
        return matrix;
    }
};

/// Where the nodes are while animations stand at their places.
class Pose {
  public:
    Pose(const SceneAnimations& all, std::span<const AnimationPlace> places)
        : all_(all), moved_(all.nodes.size()), world_(all.nodes.size()) {
        for (const AnimationPlace& place : places) {
            for (const AnimationChannel& channel : all.animations[place.animation].channels) {
                move(channel, place.seconds);
            }
        }
        for (std::size_t n = 0; n < all.nodes.size(); ++n) {
            const AnimatedNode& node = all.nodes[n];
            world_[n] = parent_world(n) * (moved_[n] ? moved_[n]->matrix() : node.parent_from_node);
        }
    }

    [[nodiscard]] std::vector<glm::dmat4> take_worlds() { return std::move(world_); }
    [[nodiscard]] const glm::dmat4& world(std::size_t node) const { return world_[node]; }

    [[nodiscard]] Transform place(const Object& object, const CarriedByNode& carried) const {
        const AnimatedNode& node = all_.nodes[carried.node];
        const std::optional<MovedNode>& moved = moved_[carried.node];
        if (carried.direct && moved && !moved_above(carried.node)) {
            return moved->transform();
        }
        const glm::dmat4 world =
            parent_world(carried.node) * (moved ? moved->matrix() : node.parent_from_object);
        return nearest_transform(glm::inverse(glm::dmat4(object.world_from_parent)) * world);
    }

  private:
    [[nodiscard]] glm::dmat4 parent_world(std::size_t n) const {
        const AnimatedNode& node = all_.nodes[n];
        return node.parent == AnimatedNode::no_parent ? node.world_from_parent
                                                      : world_[node.parent];
    }

    [[nodiscard]] bool moved_above(std::size_t n) const {
        for (std::size_t at = all_.nodes[n].parent; at != AnimatedNode::no_parent;
             at = all_.nodes[at].parent) {
            if (moved_[at]) {
                return true;
            }
        }
        return false;
    }

    void move(const AnimationChannel& channel, double seconds) {
        if (channel.value > AnimatedValue::scale) {
            return;
        }
        const AnimatedNode& node = all_.nodes[channel.target];
        std::optional<MovedNode>& moved = moved_[channel.target];
        if (!moved) {
            moved = {glm::dvec3(node.parent_from_object[3]), node.rest.rotation, node.rest.scale};
        }
        const KeyTrack& track = all_.tracks[channel.track];
        if (channel.value == AnimatedValue::translation) {
            moved->translation =
                double{all_.metres_per_unit} * glm::dvec3(track.at(seconds)) - node.offset;
        } else if (channel.value == AnimatedValue::rotation) {
            moved->rotation = track.rotation_at(seconds);
        } else {
            moved->scale = glm::vec3(track.at(seconds));
        }
    }

    const SceneAnimations& all_;
    std::vector<std::optional<MovedNode>> moved_;
    std::vector<glm::dmat4> world_;
};

/// What an animation says of one item, by value.
using Values = std::map<AnimatedValue, glm::vec4>;

/// Of the punctual lights, or of the materials.
std::map<std::size_t, Values> values_of(const SceneAnimations& all, const AnimationPlace& place,
                                        bool lights) {
    std::map<std::size_t, Values> result;
    for (const AnimationChannel& channel : all.animations[place.animation].channels) {
        const bool of_node = channel.value <= AnimatedValue::scale;
        const bool of_light = !of_node && channel.value <= AnimatedValue::outer_cone;
        if (!of_node && of_light == lights) {
            result[channel.target][channel.value] = all.tracks[channel.track].at(place.seconds);
        }
    }
    return result;
}

std::optional<glm::vec4> find(const Values& values, AnimatedValue value) {
    const auto found = values.find(value);
    return found == values.end() ? std::nullopt : std::optional(found->second);
}

std::uint32_t number_of(const Scene& scene, std::size_t punctual) {
    return static_cast<std::uint32_t>(scene.lights.size() + punctual + 1);
}

LightEdit punctual_edit(const Scene& scene, std::size_t index, const Values& values) {
    const PunctualLight& light = scene.punctual_lights[index];
    const FileLight& file = scene.animations->file_lights[index];
    LightEdit edit;
    edit.light = number_of(scene, index);
    if (light.removed || light.as_loaded) {  // exchanged: the file's candela are of another one
        return edit;
    }
    const auto intensity = find(values, AnimatedValue::intensity);
    const auto colour = find(values, AnimatedValue::colour);
    if (intensity || colour) {
        const glm::vec3 rgb = colour ? glm::max(glm::vec3(*colour), 0.0F) : file.colour;
        const float factor = intensity ? std::max(intensity->x, 0.0F) : file.intensity;
        edit.intensity = factor * luminance(rgb) * intensity_unit(light);
        if (colour && luminance(rgb) > 0.0F) {
            edit.colour = rgb;
        }
    }
    constexpr float quarter = 90.0F;
    if (const auto cone = find(values, AnimatedValue::inner_cone)) {
        edit.inner_cone = std::clamp(glm::degrees(cone->x), 0.0F, quarter);
    }
    if (const auto cone = find(values, AnimatedValue::outer_cone)) {
        edit.outer_cone = std::clamp(glm::degrees(cone->x), 0.0F, quarter);
    }
    if (edit.inner_cone && edit.outer_cone) {
        edit.inner_cone = std::min(*edit.inner_cone, *edit.outer_cone);
    }
    return edit;
}

/// What a material emits, as an edit of its light.
std::optional<LightEdit> emission_edit(const Scene& scene, std::size_t material,
                                       const Values& values) {
    const auto factor = find(values, AnimatedValue::emissive_factor);
    const auto strength = find(values, AnimatedValue::emissive_strength);
    const auto light = std::find_if(
        scene.lights.begin(), scene.lights.end(),
        [material](const Light& l) { return l.material == static_cast<int>(material); });
    if ((!factor && !strength) || light == scene.lights.end()) {
        return std::nullopt;
    }
    const FileEmission& file = scene.animations->file_emissions[material];
    const glm::vec3 radiance = light->texture *
                               (factor ? glm::max(glm::vec3(*factor), 0.0F) : file.factor) *
                               (strength ? std::max(strength->x, 0.0F) : file.strength);
    LightEdit edit;
    edit.light = light->id;
    edit.intensity = luminance(radiance);
    if (*edit.intensity > 0.0F) {
        edit.colour = radiance;
    }
    return edit;
}

LightEdit place_edit(const Scene& scene, const CarriedByNode& carried, const Pose& pose) {
    PunctualLight light = scene.punctual_lights[carried.item];
    const glm::dmat4& world = pose.world(carried.node);
    light.position = glm::vec3(world[3]);
    light.axes = glm::mat3(glm::dmat3(world));
    const LightPlace place = place_of(light);
    LightEdit edit;
    edit.light = number_of(scene, carried.item);
    if (light.kind != PunctualKind::directional) {
        edit.position = place.position;
    }
    edit.aim = place.aim;
    edit.rotation = place.rotation;
    return edit;
}

void merge(const LightEdit& from, LightEdit& into) {
    into.intensity = from.intensity;
    into.colour = from.colour;
    into.inner_cone = from.inner_cone;
    into.outer_cone = from.outer_cone;
}

}  // namespace

std::vector<glm::dmat4> node_worlds(const SceneAnimations& all,
                                    std::span<const AnimationPlace> places) {
    return Pose(all, places).take_worlds();
}

std::vector<std::pair<std::uint32_t, Transform>> object_places(
    const Scene& scene, std::span<const AnimationPlace> places) {
    const SceneAnimations& all = *scene.animations;
    const Animation& animation = all.animations[places.back().animation];
    const Pose pose(all, places);
    std::vector<std::pair<std::uint32_t, Transform>> result;
    for (const CarriedByNode& carried : all.objects) {
        if (scene.objects[carried.item].removed ||
            !std::binary_search(animation.objects.begin(), animation.objects.end(), carried.item)) {
            continue;
        }
        const Transform place = pose.place(scene.objects[carried.item], carried);
        if (problem_of(scene, carried.item, place).empty()) {
            result.emplace_back(carried.item, place);
        }
    }
    return result;
}

std::vector<LightEdit> light_edits(const Scene& scene, std::span<const AnimationPlace> places) {
    const SceneAnimations& all = *scene.animations;
    const Animation& animation = all.animations[places.back().animation];
    std::map<std::uint32_t, LightEdit> edits;
    const Pose pose(all, places);
    for (const CarriedByNode& carried : all.lights) {
        const std::uint32_t number = number_of(scene, carried.item);
        if (!scene.punctual_lights[carried.item].removed &&
            std::binary_search(animation.lights.begin(), animation.lights.end(), number)) {
            edits[number] = place_edit(scene, carried, pose);
        }
    }
    for (const auto& [index, values] : values_of(all, places.back(), true)) {
        const LightEdit edit = punctual_edit(scene, index, values);
        LightEdit& sum = edits[edit.light];
        sum.light = edit.light;
        merge(edit, sum);
    }
    for (const auto& [material, values] : values_of(all, places.back(), false)) {
        if (const auto edit = emission_edit(scene, material, values)) {
            edits[edit->light] = *edit;
        }
    }
    std::vector<LightEdit> result;
    for (const auto& [number, edit] : edits) {
        if (problem_of(scene, edit).empty()) {
            result.push_back(edit);
        }
    }
    return result;
}

std::vector<MaterialEdit> material_edits(const Scene& scene,
                                         std::span<const AnimationPlace> places) {
    std::vector<MaterialEdit> result;
    for (const auto& [index, values] : values_of(*scene.animations, places.back(), false)) {
        MaterialEdit edit;
        edit.material = static_cast<std::uint32_t>(index + 1);
        if (const auto colour = find(values, AnimatedValue::base_colour)) {
            edit.base_colour = glm::clamp(glm::vec3(*colour), 0.0F, 1.0F);
        }
        if (const auto roughness = find(values, AnimatedValue::roughness)) {
            edit.roughness = std::clamp(roughness->x, 0.0F, 1.0F);
        }
        if (const auto metallic = find(values, AnimatedValue::metallic)) {
            edit.metallic = std::clamp(metallic->x, 0.0F, 1.0F);
        }
        const bool any = edit.base_colour || edit.roughness || edit.metallic;
        if (any && problem_of(scene, edit).empty()) {
            result.push_back(edit);
        }
    }
    return result;
}

std::size_t find_animation(const Scene& scene, const std::string& name) {
    if (!scene.animations) {
        return 0;
    }
    const auto& all = scene.animations->animations;
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&name](const Animation& one) { return one.name == name; });
    return static_cast<std::size_t>(found - all.begin());
}

std::string animation_names(const Scene& scene) {
    std::string names;
    for (std::size_t i = 0; scene.animations && i < scene.animations->animations.size(); ++i) {
        names += (names.empty() ? "'" : ", '") + scene.animations->animations[i].name + "'";
    }
    return names.empty() ? "none" : names;
}

}  // namespace raybundle
