// SPDX-License-Identifier: Apache-2.0
// Rooms as they come out of architects' programs: through a file, with one defect each.
#pragma once

#include <string>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

enum class Defect {
    none,
    duplicate_faces,   ///< one wall twice in its object
    duplicate_object,  ///< one wall again, as another object
    t_junctions,       ///< a floor of three rectangles whose corners do not meet
    gaps,              ///< 1 mm between all walls
    flipped_wall,
    missing_wall,
    slivers,  ///< 1000 triangles without area in the room
};

std::string name_of(Defect defect);

/// A room of 4 x 3 x 5 m of albedo 0.6, turned, with a lamp below its ceiling.
struct DefectiveRoom {
    explicit DefectiveRoom(Defect defect);

    /// Of the floor, given the values of all patches; the floor itself has no defect but
    /// T-junctions.
    [[nodiscard]] double floor_mean(const std::vector<double>& values) const;

    Scene scene;
    PatchMesh mesh;
};

}  // namespace raybundle
