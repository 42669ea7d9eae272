// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/animation/gltf_animations.h"
#include "scene/gltf/file/gltf_bake.h"
#include "scene/gltf/gltf_geometry.h"
#include "scene/gltf/gltf_lights.h"
#include "scene/gltf/gltf_objects.h"

namespace raybundle {

/// What has become of the nodes of a file.
struct NodeUses {
    const GltfNodeTree& tree;
    float metres_per_unit = 1.0F;
    const std::vector<NodeGeometry>& geometries;
    const std::vector<ObjectPlan>& plans;      ///< of each of Scene::objects
    const std::vector<LightSource>& sources;   ///< of each of Scene::punctual_lights
    const std::vector<BakedPrimitive>& baked;  ///< of what find_deforming() has named
};

/// Sets scene.animations: which objects, lights and materials the file's animations move or change.
/// What moves nothing that is shown is left out with a notice.
void link_animations(GltfDocument& document, const FileAnimations& file, const NodeUses& uses,
                     Scene& scene);

}  // namespace raybundle
