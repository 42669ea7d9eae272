// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace raybundle {

/// Divides the only object of a file that says nothing of objects into its connected parts, so that
/// they can be selected and moved. Parts whose bounds lie in those of another part, as pillows lie
/// in a bed's, stay with it; small ones, and what there is beyond the 256 largest, with the rest,
/// which stays object 1. Does nothing to scenes of several objects, or of one that is movable.
/// Returns the number of objects then.
std::size_t split_lone_object(Scene& scene);

}  // namespace raybundle
