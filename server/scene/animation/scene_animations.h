// SPDX-License-Identifier: Apache-2.0
// What a file animates, and what its scene looks like at a time of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/animation/deforming_shape.h"
#include "scene/animation/key_track.h"
#include "scene/edit/surface_edit.h"
#include "scene/scene.h"

namespace raybundle {

enum class AnimatedValue {
    translation,  // of a node: metres
    rotation,
    scale,
    intensity,  // of a punctual light: cd or lx, factor of a profile
    colour,
    inner_cone,  // radians
    outer_cone,
    base_colour,  // of a material: linear factor, alpha is ignored
    roughness,
    metallic,
    emissive_factor,
    emissive_strength,
    morph_weights,  ///< of a node: as many as its mesh has targets
};

/// A channel of an animation: what goes by its track.
struct AnimationChannel {
    AnimatedValue value = AnimatedValue::translation;
    /// Index into SceneAnimations::nodes, Scene::punctual_lights, Scene::materials or
    /// SceneAnimations::morph_weights.
    std::size_t target = 0;
    std::size_t track = 0;  ///< index into SceneAnimations::tracks
};

/// What is animated under one name.
struct Animation {
    std::string name;  ///< unlike all others
    double seconds = 0.0;
    std::vector<AnimationChannel> channels;
    std::vector<AnimationChannel> weights;  ///< those of morph_weights
    std::vector<std::uint32_t> shapes;      ///< objects that it deforms; sorted
    std::vector<std::uint32_t> objects;     ///< that it moves: Scene::objects; sorted
    std::vector<std::uint32_t> lights;      ///< changes or moves, LightEdit::light; sorted
    std::vector<std::uint32_t> materials;   ///< changes, MaterialEdit::material; sorted
};

/// A node that an animation moves, or one between such a node and what it carries. Matrices in
/// double precision, lengths in m.
struct AnimatedNode {
    std::size_t parent = no_parent;      ///< an earlier one of SceneAnimations::nodes
    glm::dmat4 world_from_parent{1.0};   ///< of one without such a parent
    Transform rest;                      ///< where the file puts it
    glm::dmat4 parent_from_object{1.0};  ///< the same as a matrix
    /// The same with what translation, rotation and scale cannot express.
    glm::dmat4 parent_from_node{1.0};
    glm::dvec3 offset{0.0};  ///< taken out of translations: Scene::origin, of a root

    static constexpr std::size_t no_parent = static_cast<std::size_t>(-1);
};

/// An object or a light without object that goes with an animated node.
struct CarriedByNode {
    std::size_t node = 0;    ///< index into SceneAnimations::nodes
    std::uint32_t item = 0;  ///< index into Scene::objects or Scene::punctual_lights
    bool direct = false;     ///< an object whose transform is the node's
};

/// A light as the file has it.
struct FileLight {
    float intensity = 1.0F;
    glm::vec3 colour{1.0F};
};

/// Emission of a material likewise.
struct FileEmission {
    glm::vec3 factor{0.0F};
    float strength = 1.0F;
};

/// The animations of a file.
struct SceneAnimations {
    std::vector<Animation> animations;
    std::vector<KeyTrack> tracks;
    float metres_per_unit = 1.0F;     ///< of translations in tracks
    std::vector<AnimatedNode> nodes;  ///< parents before children
    std::vector<CarriedByNode> objects;
    std::vector<CarriedByNode> lights;
    std::vector<FileLight> file_lights;        ///< of each of Scene::punctual_lights, suns aside
    std::vector<FileEmission> file_emissions;  ///< of each of Scene::materials
    std::vector<DeformingShape> shapes;        ///< see scene/animation/shape_pose.h
    std::vector<RestShape> rests;
    std::vector<ShapeSkin> skins;
    std::vector<std::vector<float>> morph_weights;  ///< of nodes, as the file has them
};

/// Where an animation stands.
struct AnimationPlace {
    std::size_t animation = 0;  ///< index into SceneAnimations::animations
    double seconds = 0.0;
};

/// Whether it does nothing but deform.
inline bool only_deforms(const Animation& animation) {
    return animation.objects.empty() && animation.lights.empty() && animation.materials.empty();
}

/// World from node of SceneAnimations::nodes while animations stand at their places.
std::vector<glm::dmat4> node_worlds(const SceneAnimations& all,
                                    std::span<const AnimationPlace> places);

/// Where the objects that places.back() moves are, with what the others have moved of the nodes
/// above them; of two that move one node the later one counts.
std::vector<std::pair<std::uint32_t, Transform>> object_places(
    const Scene& scene, std::span<const AnimationPlace> places);

/// What lights are that places.back() moves or changes; those without problem only.
std::vector<LightEdit> light_edits(const Scene& scene, std::span<const AnimationPlace> places);

/// What materials are that places.back() changes; those without problem only.
std::vector<MaterialEdit> material_edits(const Scene& scene,
                                         std::span<const AnimationPlace> places);

/// Index of an animation by its name; size() of all where there is none.
std::size_t find_animation(const Scene& scene, const std::string& name);

/// "'door', 'lift'", or "none".
std::string animation_names(const Scene& scene);

}  // namespace raybundle
