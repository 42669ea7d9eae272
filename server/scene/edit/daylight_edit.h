// SPDX-License-Identifier: Apache-2.0
// Daylight that changes while a scene is being shown.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.h"

namespace raybundle {

/// Why daylight cannot be set; empty where it can.
std::string problem_of(const DaylightSetting& daylight);

/// Gives the scene that daylight, its sky and its sun undimmed. From the first time on the scene
/// keeps a sky and a sun among its lights, dark ones where there are none, so that lights keep
/// their numbers.
void apply(Scene& scene, const DaylightSetting& daylight);

/// Whether its sky or one of its suns has been dimmed, coloured or switched off.
bool daylight_dimmed(const Scene& scene);

}  // namespace raybundle
