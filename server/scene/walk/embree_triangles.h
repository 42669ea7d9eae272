// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <span>

#include "scene/scene.h"

namespace raybundle {

/// Gives an Embree geometry these triangles of a scene (indices) at their objects' initial places,
/// world, m; primitive i is triangles[i]. Triangles share the scene's vertices. Throws
/// std::bad_alloc.
void set_triangles(RTCGeometry geometry, const Scene& scene,
                   std::span<const std::uint32_t> triangles);

}  // namespace raybundle
