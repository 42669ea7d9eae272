// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/mesh/edge_refinement.h"
#include "scene/mesh/joins/triangle_joins.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle {

/// Welds corners to vertices, averages textures over triangles, joins small ones (join.most_sets:
/// of all patches, those of one triangle included). Frees the refinement on the way. Appends to
/// scene.notices. Throws SceneError where nothing is left.
PatchMesh build_mesh(Scene& scene, EdgeRefinement refinement, const JoinSettings& join);

}  // namespace raybundle
