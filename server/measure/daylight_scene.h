// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// Illuminance that the sky of leave_overcast_sky() gives an open horizontal plane, lx: a daylight
/// factor of 1 % is a hundredth of it.
inline constexpr double overcast_illuminance = 10'000.0;

/// Takes all lamps and suns out of a scene and gives it an overcast sky: of CIE type 1 where its
/// own sky has that one, else the traditional one (type 16), above a ground of the albedo that its
/// own sky has, else 0.2.
void leave_overcast_sky(Scene& scene, PatchMesh& mesh);

/// Dims each lamp to what its own maintenance factor leaves of it; sky and suns stay as they are.
void maintain_lamps(Scene& scene, PatchMesh& mesh);

}  // namespace raybundle
