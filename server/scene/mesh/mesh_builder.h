// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/mesh/edge_refinement.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/mesh/triangle_joins.h"

namespace raybundle {

/// Welds corners to vertices, averages textures over triangles, joins small ones (join.most_sets:
/// of all patches, those of one triangle included). Appends to scene.notices. Throws SceneError
/// where nothing is left.
PatchMesh build_mesh(Scene& scene, const EdgeRefinement& refinement, const JoinSettings& join);

}  // namespace raybundle
