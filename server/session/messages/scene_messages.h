// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "net/ws/client_event.h"
#include "raybundle.pb.h"
#include "scene/edit/surface_edit.h"
#include "scene/effects/effects_plan.h"
#include "scene/scene.h"

namespace raybundle {

glm::vec3 from_message(const v1::Vec3& v);
Transform from_message(const v1::Transform& transform);
MaterialEdit from_message(const v1::SetMaterial& material);
void to_message(const glm::vec3& v, v1::Vec3* message);
void to_message(const glm::uvec2& size, v1::Viewport* message);
void to_message(const Bounds& bounds, v1::Bounds* message);
void to_message(const Transform& transform, v1::Transform* message);
void to_message(const Effect& effect, v1::Effect* message);

/// World bounds of an object at its present transform.
Bounds world_bounds(const Object& object);

/// Why a change cannot be made of this scene, with field and reason; an unset code where it can.
v1::Error problem_of(const Scene& scene, const v1::SceneChanged& change);
/// Everything that the subject of a change is now: a change that would bring it back to that.
v1::SceneChanged state_of(const Scene& scene, const v1::SceneChanged& change);
/// Makes a change without problem. Patches get their colours by refresh_surfaces().
void apply(Scene& scene, const v1::SceneChanged& change);

void describe_object(const Object& object, v1::Object* out);
void describe_material(const Scene& scene, std::size_t material, v1::Material* out);
/// What `welcome` says about the scene: objects, lights, cameras, materials, effects.
void describe_scene(const Scene& scene, v1::Scene* message);

}  // namespace raybundle
