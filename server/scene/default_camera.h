// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace raybundle {

/// A camera for a scene that has none. Seen from the middle of the scene, rays that meet front
/// sides on nearly every side tell an interior: the camera stands inside, looking along the longest
/// free line. If only one side is open (a stage), the camera looks in from there. Otherwise the
/// scene is an object, seen from in front and a little above. `scene.bounds` must not be empty.
Camera default_camera(const Scene& scene);

}  // namespace raybundle
