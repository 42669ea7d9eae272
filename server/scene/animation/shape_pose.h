// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "scene/animation/scene_animations.h"

namespace raybundle {

/// Puts the vertices of skins and morph targets, and the bounds of their objects, to where
/// animations have them; what none of them moves is where the file puts it. Of two that move one
/// node the later one counts. The scene's bounds grow where need be. Triangles stay, even those
/// that lose their area. Returns whether any vertex has changed.
bool pose_shapes(Scene& scene, std::span<const AnimationPlace> places);

}  // namespace raybundle
