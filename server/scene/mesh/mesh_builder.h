// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/mesh/edge_refinement.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/mesh/triangle_joins.h"

namespace raybundle {

/// Which of the refined triangles share their light with others.
struct JoinedFaces {
    std::vector<bool> small;  ///< by number in EdgeRefinement::triangles()
    JoinSettings settings;    ///< most_sets: of all patches, those of one triangle included
};

/// Welds corners to vertices, averages textures over triangles, joins small ones. Appends to
/// scene.notices. Throws SceneError where nothing is left.
PatchMesh build_mesh(Scene& scene, const EdgeRefinement& refinement, const JoinedFaces& joined);

}  // namespace raybundle
