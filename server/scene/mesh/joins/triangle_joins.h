// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/mesh/joins/join_faces.h"

namespace raybundle {

/// Sides are those of sets: two of two-sided ones.
struct JoinSettings {
    double edge = 0.0;             ///< target edge of patches, m
    double patch_area = 0.0;       ///< usual area of such a patch, m²
    std::size_t wanted_sides = 0;  ///< nothing joins any more where there are no more
    std::size_t most_sides = 0;    ///< where there are more, sets become larger than such patches
};

/// Joins faces to sets that are about as large as patches of the target edge. What a set costs is
/// how its light is misplaced, as far as geometry tells: the sum of area times squared distance,
/// from the mean place, from the mean normal (in target edges), from the mean colour (likewise).
/// Sets with the least added cost join first (Ward 1963), in steps of the cost that may be, up to
/// that of one such patch.
///
/// Faces join that share an edge, and in the end sets that are near each other, but only where one
/// sees the other past what stands between: no set reaches through a wall or below one. All normals
/// of a set are on one side of its mean normal's plane. Where that leaves too many sets, neighbours
/// join whatever is between them and wherever they face, the smallest first: one a rough kind is
/// the least there can be.
///
/// Returns the set of each face, numbered in the order of the first faces. Deterministic; the time
/// grows like n log n. Throws std::bad_alloc where there is no memory for rays.
std::vector<std::uint32_t> join_faces(const Scene& scene, const JoinFaces& faces,
                                      const JoinSettings& settings);

}  // namespace raybundle
