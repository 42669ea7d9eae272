// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "gpu/layouts.h"
#include "scene/scene.h"

namespace raybundle {

/// What the shaders need of a camera, in the shifted world: clip matrix (reversed infinite depth),
/// eye and the vectors that span the picture. near_distance in metres; size in pixels.
layout::ViewParameters make_view_parameters(const Camera& camera, const glm::vec3& scene_origin,
                                            glm::uvec2 size, float near_distance);

/// ViewParameters::size of a picture with so many pixels.
glm::uvec4 picture_size(glm::uvec2 pixels);

/// Direction (unit, world) through a pixel of the picture, row 0 at the top.
glm::vec3 pixel_direction(const Camera& camera, glm::uvec2 size, glm::vec2 pixel);

}  // namespace raybundle
