// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "scene/gltf/file/gltf_document.h"
#include "scene/gltf/gltf_node_tree.h"
#include "scene/gltf/gltf_objects.h"
#include "scene/scene.h"

namespace raybundle {

/// Where a punctual light comes from.
struct LightSource {
    std::size_t node = 0;
    std::optional<std::size_t> definition;   ///< entry of KHR_lights_punctual's lights
    std::size_t number = SavedObject::last;  ///< of a saved scene: its place among the lights
    float intensity = 1.0F;                  ///< as the file has it
    glm::vec3 colour{1.0F};                  ///< likewise
};

/// Adds the KHR_lights_punctual and EXT_lights_ies lights of the shown scene's visible nodes to
/// scene.punctual_lights, in the order of the nodes and named after them. A light in the subtree of
/// an object belongs to it and moves with it, unless an animation moves (`moved`, of each node) the
/// light's node or one between them. scene.objects must be those of `plans`. Throws
/// SceneError for indices out of range, profiles that cannot be read, cones without an angle
/// between them and more lights than can be kept.
/// Returns the source of each.
std::vector<LightSource> read_punctual_lights(GltfDocument& document, const GltfNodeTree& tree,
                                              const std::vector<ObjectPlan>& plans,
                                              const std::vector<bool>& moved, Scene& scene);

}  // namespace raybundle
