// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "scene/scene.h"

namespace raybundle {

/// Pixel of a picture that shows a point, row 0 at the top; nothing where the point lies outside.
std::optional<glm::uvec2> pixel_of(const Camera& camera, glm::uvec2 size, const glm::vec3& point);

}  // namespace raybundle
