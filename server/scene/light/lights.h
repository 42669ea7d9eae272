// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// The luminaires of a scene: one for each material that emits, or that the file switches off, and
/// is used, in the order of the materials. Named after the material, or after the first object that
/// uses it. Radiance is the area mean over its triangles.
std::vector<Light> find_lights(const Scene& scene);

/// Sets the areas of the scene's lights, once it is known which surfaces have two sides.
void measure_lights(Scene& scene);

}  // namespace raybundle
