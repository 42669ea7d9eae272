// SPDX-License-Identifier: Apache-2.0
#include "session/messages/scene_messages.h"

#include <algorithm>

#include "journal/change_sum.h"
#include "scene/edit/daylight_edit.h"
#include "scene/effects/effects_plan.h"
#include "scene/object_kind.h"
#include "scene/object_limits.h"
#include "session/messages/addition_messages.h"
#include "session/messages/daylight_messages.h"
#include "session/messages/light_messages.h"

namespace raybundle {

glm::vec3 from_message(const v1::Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

Transform from_message(const v1::Transform& transform) {
    Transform result;
    if (transform.has_translation()) {
        result.translation = from_message(transform.translation());
    }
    if (transform.has_rotation()) {
        const auto& q = transform.rotation();
        result.rotation = glm::normalize(glm::quat(q.w(), q.x(), q.y(), q.z()));
    }
    if (transform.has_scale()) {
        result.scale = from_message(transform.scale());
    }
    return result;
}

MaterialEdit from_message(const v1::SetMaterial& material) {
    MaterialEdit edit;
    edit.material = material.material();
    if (material.has_base_colour()) {
        edit.base_colour = from_message(material.base_colour());
    }
    if (material.has_roughness()) {
        edit.roughness = material.roughness();
    }
    if (material.has_metallic()) {
        edit.metallic = material.metallic();
    }
    return edit;
}

void to_message(const glm::vec3& v, v1::Vec3* message) {
    message->set_x(v.x);
    message->set_y(v.y);
    message->set_z(v.z);
}

void to_message(const glm::uvec2& size, v1::Viewport* message) {
    message->set_width(size.x);
    message->set_height(size.y);
}

void to_message(const Bounds& bounds, v1::Bounds* message) {
    to_message(bounds.empty() ? glm::vec3(0.0F) : bounds.min, message->mutable_min());
    to_message(bounds.empty() ? glm::vec3(0.0F) : bounds.max, message->mutable_max());
}

void to_message(const Transform& transform, v1::Transform* message) {
    to_message(transform.translation, message->mutable_translation());
    message->mutable_rotation()->set_x(transform.rotation.x);
    message->mutable_rotation()->set_y(transform.rotation.y);
    message->mutable_rotation()->set_z(transform.rotation.z);
    message->mutable_rotation()->set_w(transform.rotation.w);
    to_message(transform.scale, message->mutable_scale());
}

void to_message(const Effect& effect, v1::Effect* message) {
    message->set_name(effect.name);
    message->set_active(effect.active);
    message->set_reason(effect.reason);
    message->set_path_class(effect.path_class);
    message->set_share_bound(static_cast<float>(effect.share_bound));
    message->set_bytes_per_patch(static_cast<std::uint32_t>(effect.bytes_per_patch));
    if (effect.ms_per_iteration) {
        message->set_ms_per_iteration(static_cast<float>(*effect.ms_per_iteration));
    }
}

Bounds world_bounds(const Object& object) {
    const glm::mat4 matrix = object.world_from_object();
    Bounds result;
    if (object.bounds.empty()) {
        return result;
    }
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1U) != 0 ? object.bounds.max.x : object.bounds.min.x,
                          (corner & 2U) != 0 ? object.bounds.max.y : object.bounds.min.y,
                          (corner & 4U) != 0 ? object.bounds.max.z : object.bounds.min.z);
        result.add(glm::vec3(matrix * glm::vec4(p, 1.0F)));
    }
    return result;
}

namespace {

void describe_effects(const Scene& scene, v1::Scene* message) {
    for (const Effect& effect : plan_effects(scene, 0).effects) {
        to_message(effect, message->add_effects());
    }
}

v1::Error error(v1::Error::Code code, const std::string& message) {
    v1::Error result;
    result.set_code(code);
    result.set_message(message);
    return result;
}

}  // namespace

v1::Error problem_of(const Scene& scene, const v1::SceneChanged& change) {
    const std::uint32_t id = subject_of(change).second;
    if (change.has_move_object()) {
        const bool known = id >= 1 && id <= scene.objects.size();
        if (known && scene.objects[id - 1].movable) {
            const std::string problem =
                problem_of(scene, id - 1, from_message(change.move_object().transform()));
            return problem.empty()
                       ? v1::Error()
                       : error(v1::Error::INVALID_ARGUMENT, "moveObject.transform." + problem);
        }
        return error(known ? v1::Error::INVALID_ARGUMENT : v1::Error::NOT_FOUND,
                     "moveObject.object: no movable object " + std::to_string(id));
    }
    if (change.has_set_daylight()) {
        const std::string wrong = problem_of(scene, change.set_daylight());
        return wrong.empty() ? v1::Error()
                             : error(v1::Error::INVALID_ARGUMENT, "setDaylight." + wrong);
    }
    if (change.has_add_object()) {
        const std::string wrong = problem_of(scene, change.add_object());
        return wrong.empty() ? v1::Error() : error(v1::Error::NOT_FOUND, wrong);
    }
    if (change.has_add_luminaire()) {
        const std::string wrong = problem_of(scene, change.add_luminaire());
        const bool absent =
            change.add_luminaire().removed() && !has_light(scene, change.add_luminaire().light());
        return wrong.empty()
                   ? v1::Error()
                   : error(absent ? v1::Error::NOT_FOUND : v1::Error::INVALID_ARGUMENT, wrong);
    }
    const bool light = change.has_set_light();
    const std::string problem = light ? problem_of(scene, change.set_light())
                                      : problem_of(scene, from_message(change.set_material()));
    const bool known = light ? has_light(scene, id) : id >= 1 && id <= scene.materials.size();
    return problem.empty() ? v1::Error()
                           : error(known ? v1::Error::INVALID_ARGUMENT : v1::Error::NOT_FOUND,
                                   (light ? "setLight." : "setMaterial.material: ") + problem);
}

v1::SceneChanged state_of(const Scene& scene, const v1::SceneChanged& change) {
    const std::uint32_t id = subject_of(change).second;
    v1::SceneChanged state;
    if (change.has_move_object()) {
        state.mutable_move_object()->set_object(id);
        to_message(scene.objects[id - 1].transform,
                   state.mutable_move_object()->mutable_transform());
    } else if (change.has_set_daylight()) {
        *state.mutable_set_daylight() = state_of_daylight(scene);
    } else if (change.has_set_light()) {
        *state.mutable_set_light() = state_of_light(scene, id);
    } else if (change.has_add_object()) {
        *state.mutable_add_object() = state_of_addition(scene, change.add_object());
    } else if (change.has_add_luminaire()) {
        *state.mutable_add_luminaire() = state_of_addition(scene, change.add_luminaire());
    } else {
        const Material& material = scene.materials[id - 1];
        v1::SetMaterial* message = state.mutable_set_material();
        message->set_material(id);
        to_message(material.base_colour, message->mutable_base_colour());
        if (!material.max_phong) {
            message->set_roughness(material.roughness);
            message->set_metallic(material.metallic);
        }
    }
    return state;
}

void apply(Scene& scene, const v1::SceneChanged& change) {
    if (change.has_move_object()) {
        const v1::MoveObject& move = change.move_object();
        scene.objects[move.object() - 1].transform = from_message(move.transform());
    } else if (change.has_set_daylight()) {
        apply(scene, from_message(change.set_daylight()));
    } else if (change.has_set_light()) {
        apply(scene, from_message(change.set_light()));
    } else if (change.has_add_object()) {
        apply(scene, change.add_object());
    } else if (change.has_add_luminaire()) {
        apply(scene, change.add_luminaire());
    } else {
        apply(scene, from_message(change.set_material()));
    }
}

void describe_object(const Object& object, v1::Object* out) {
    out->set_id(object.id);
    out->set_name(object.name);
    out->set_movable(object.movable);
    out->set_kind(object.kind == ObjectKind::door        ? v1::Object::DOOR
                  : object.kind == ObjectKind::structure ? v1::Object::STRUCTURE
                                                         : v1::Object::THING);
    for (const std::string& name : object.path) {
        out->add_path(name);
    }
    out->set_storey(storey_of(object.path));
    to_message(world_bounds(object), out->mutable_bounds());
    to_message(object.transform, out->mutable_transform());
    for (int i = 0; i < 16; ++i) {
        out->add_world_from_parent(object.world_from_parent[i / 4][i % 4]);
    }
    out->set_added(object.added != nullptr);
}

void describe_material(const Scene& scene, std::size_t material, v1::Material* out) {
    out->set_id(static_cast<std::uint32_t>(material) + 1);
    out->set_name(scene.materials[material].name);
    to_message(scene.materials[material].base_colour, out->mutable_base_colour());
    out->set_roughness(scene.materials[material].roughness);
    out->set_metallic(scene.materials[material].metallic);
    out->set_matt(scene.materials[material].specular == 0.0F);
}

void describe_scene(const Scene& scene, v1::Scene* message) {
    message->set_name(scene.name);
    to_message(scene.bounds, message->mutable_bounds());
    for (const Object& object : scene.objects) {
        if (!object.removed) {
            describe_object(object, message->add_objects());
        }
    }
    describe_lights(scene, message);
    describe_luminaires(message);
    *message->mutable_daylight() = state_of_daylight(scene);
    for (const Camera& camera : scene.cameras) {
        v1::Camera* out = message->add_cameras();
        out->set_name(camera.name);
        to_message(camera.eye, out->mutable_eye());
        to_message(camera.target, out->mutable_target());
        to_message(camera.up, out->mutable_up());
        out->set_vertical_fov(camera.vertical_fov);
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        describe_material(scene, i, message->add_materials());
    }
    describe_effects(scene, message);
}

}  // namespace raybundle
