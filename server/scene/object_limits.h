// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "scene/scene.h"

namespace raybundle {

/// Farthest that an object may be moved from zero along any axis, m: single precision places it to
/// a centimetre there, or, in larger scenes, to what bundles tell apart.
double farthest_place(const Scene& scene);

/// Why an object cannot have a transform, with its field and the limit; empty where it can.
std::string problem_of(const Scene& scene, std::size_t object, const Transform& transform);

}  // namespace raybundle
