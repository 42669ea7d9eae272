// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "oracle/scene_builder.h"

namespace raybundle {

/// A light of the scene at a place and along a direction before the builder's matrix. Cones: 20 and
/// 35 degrees.
void add_punctual_light(SceneBuilder& builder, const glm::mat4& world, PunctualKind kind,
                        const glm::vec3& position, const glm::vec3& direction,
                        const glm::vec3& intensity);

/// A room of 4 m x 3 m x 4 m without its front (z = 0), turned by `where`, with a box in it, lit by
/// a lamp, a spot that points at the box, and sunlight from the front. n: cells along a wall.
SceneBuilder lit_room(const glm::mat4& where, std::uint32_t n);
/// A view into it from the front.
Camera lit_room_camera(const glm::mat4& where);

}  // namespace raybundle
