// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "net/client_event.h"
#include "raybundle.pb.h"
#include "scene/scene.h"

namespace raybundle {

glm::vec3 from_message(const v1::Vec3& v);
Transform from_message(const v1::Transform& transform);
void to_message(const glm::vec3& v, v1::Vec3* message);
void to_message(const Bounds& bounds, v1::Bounds* message);
void to_message(const Transform& transform, v1::Transform* message);

/// World bounds of an object at its present transform.
Bounds world_bounds(const Object& object);

/// What `welcome` says about the scene: objects, lights, cameras, materials, effects.
void describe_scene(const Scene& scene, v1::Scene* message);

}  // namespace raybundle
