// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "scene/scene.h"

namespace raybundle {

/// True for a triangle without area: its height is below what fp32 coordinates of its size can
/// resolve (2e-7 of its longest edge), so that its normal would be rounding error.
bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Removes triangles that have no area, where their objects are; of removed objects none.
void remove_degenerate_triangles(Scene& scene);

/// Removes faces that repeat an earlier one of the same object: same three positions, same side.
/// Of two such faces only one can be seen, and which would be chance. Faces back to back stay: they
/// are the two sides of a wall. Returns how many were removed.
std::size_t remove_duplicate_faces(Scene& scene);

/// Irregular edges, counted over the welded triangles of each object.
struct EdgeDefects {
    std::size_t boundary = 0;      ///< edges of one triangle: the rim of an open surface, a gap
    std::size_t non_manifold = 0;  ///< edges of more than two triangles
};

EdgeDefects count_edge_defects(const Scene& scene);

}  // namespace raybundle
