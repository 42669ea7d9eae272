// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// Takes an effect of the effects plan (scene/effects/effects_plan.h) out of a scene and its mesh,
/// by its name there, for measuring what it costs. False where that is not possible, as for
/// `diffuse`.
bool remove_effect(std::string_view name, Scene& scene, PatchMesh& mesh);

}  // namespace raybundle
