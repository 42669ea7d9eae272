// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "oracle/scene_builder.h"

namespace raybundle {

/// A ball of n x 2n quads.
void add_ball(SceneBuilder& b, const glm::vec3& centre, float radius, int n,
              std::uint32_t material);

}  // namespace raybundle
