// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// Whether some surface has another one, looking the other way, right behind it: nearer than a
/// small share of the scene's size, so that rasterised bundles need help to keep the two apart.
bool has_thin_walls(const Scene& scene, const PatchMesh& mesh);

/// Whether some facet is narrower than a pixel of a window of 400, so that the rasteriser turns it
/// over often enough to matter (folded_over in shaders/bundle/parallel.glsl).
bool has_slivers(const Scene& scene, const PatchMesh& mesh);

}  // namespace raybundle
