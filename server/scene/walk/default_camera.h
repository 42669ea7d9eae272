// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// Cameras for a scene that has none, the best first. If only one side is open (a stage), a camera
/// looks in from there. In rooms with floors cameras stand (standing_views.h); in others, which
/// rays tell that meet front sides on nearly every side, one looks along the longest free line. The
/// last one sees all from outside, in front and a little above. `scene.bounds` must not be empty.
std::vector<Camera> default_cameras(const Scene& scene);

}  // namespace raybundle
