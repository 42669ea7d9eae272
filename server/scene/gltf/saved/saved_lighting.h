// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/gltf_lights.h"
#include "scene/gltf/saved/saved_state.h"
#include "scene/scene.h"

namespace raybundle {

/// The lighting scenes of a saved scene, whose lamps are named by material or node. sources: of
/// the first of Scene::punctual_lights.
std::vector<SavedLightingScene> saved_lighting_scenes(const SavedState& state,
                                                      const std::vector<LightSource>& sources,
                                                      const Scene& scene);

}  // namespace raybundle
