// SPDX-License-Identifier: Apache-2.0
#include "session/messages/addition_messages.h"

#include <algorithm>
#include <set>

#include "journal/change_sum.h"
#include "scene/edit/light_edit.h"
#include "scene/edit/luminaire_edit.h"
#include "session/messages/light_messages.h"
#include "session/messages/scene_messages.h"

namespace raybundle {

AddedLuminaire from_message(const v1::AddLuminaire& luminaire) {
    AddedLuminaire result;
    result.number = luminaire.light();
    result.name = luminaire.name();
    result.photometry = luminaire.photometry();
    result.position = from_message(luminaire.position());
    result.aim = luminaire.has_aim() ? from_message(luminaire.aim()) : glm::vec3(0.0F, -1.0F, 0.0F);
    result.rotation = luminaire.rotation();
    result.group = luminaire.group();
    return result;
}

std::vector<v1::AddLuminaire> field_of(const Scene& scene, const v1::AddLuminaire& request) {
    const std::uint32_t columns = std::max(request.columns(), 1U);
    const std::uint32_t rows = std::max(request.rows(), 1U);
    const std::uint32_t first = next_luminaire(scene);
    const std::string& file = request.photometry();
    const std::string name =
        request.name().empty() ? file.substr(0, file.find_last_of('.')) : request.name();
    std::vector<v1::AddLuminaire> field;
    for (std::uint32_t i = 0; i < columns * rows; ++i) {
        v1::AddLuminaire& one = field.emplace_back(request);
        for (const auto& clear :
             {&v1::AddLuminaire::clear_columns, &v1::AddLuminaire::clear_rows,
              &v1::AddLuminaire::clear_column_step, &v1::AddLuminaire::clear_row_step}) {
            (one.*clear)();
        }
        one.set_light(first + i);
        one.set_name(columns * rows > 1 ? name + " " + std::to_string(i + 1) : name);
        const std::uint32_t row = i / columns;
        to_message(from_message(request.position()) +
                       static_cast<float>(i % columns) * from_message(request.column_step()) +
                       static_cast<float>(row) * from_message(request.row_step()),
                   one.mutable_position());
        to_message(from_message(request).aim, one.mutable_aim());
    }
    return field;
}

std::string problem_of(const Scene& scene, const v1::AddLuminaire& change) {
    if (change.removed()) {
        const std::string problem = removal_problem(scene, change.light());
        return problem.empty() ? "" : "removeLight.light: " + problem;
    }
    if (punctual_index(scene, change.light())) {
        return "";
    }
    const std::string problem = change.photometry().empty()
                                    ? "light: no light " + std::to_string(change.light())
                                    : problem_of(scene, from_message(change));
    return problem.empty() ? "" : "addLuminaire." + problem;
}

v1::AddLuminaire state_of_addition(const Scene& scene, const v1::AddLuminaire& change) {
    const auto index = punctual_index(scene, change.light());
    v1::AddLuminaire state;
    if (!index) {
        state = change;
        state.set_removed(true);
        return state;
    }
    const PunctualLight& light = scene.punctual_lights[*index];
    state.set_light(change.light());
    state.set_removed(light.removed);
    if (light.added) {
        state.set_name(light.added->name);
        state.set_photometry(light.added->photometry);
        to_message(light.added->position, state.mutable_position());
        to_message(light.added->aim, state.mutable_aim());
        state.set_rotation(light.added->rotation);
        state.set_group(light.added->group);
    }
    return state;
}

void apply(Scene& scene, const v1::AddLuminaire& change) {
    if (!punctual_index(scene, change.light()) && !change.photometry().empty()) {
        add_luminaire(scene, from_message(change));
    }
    set_light_removed(scene, change.light(), change.removed());
}

AddedObject from_message(const v1::AddObject& object) {
    AddedObject result;
    result.copy_of = object.copy_of();
    result.library = object.library();
    result.name = object.name();
    result.transform = from_message(object.transform());
    return result;
}

bool grows(const Scene& scene, const v1::SceneChanged& change) {
    return change.has_add_object() && change.add_object().object() > scene.objects.size();
}

std::string problem_of(const Scene& scene, const v1::AddObject& change) {
    const std::uint32_t id = change.object();
    const bool known = id >= 1 && id <= scene.objects.size();
    if (change.removed()) {
        const bool removable =
            known && scene.objects[id - 1].movable && !scene.objects[id - 1].removed;
        return removable ? "" : "removeObject.object: no movable object " + std::to_string(id);
    }
    const bool next = std::size_t{id} == scene.objects.size() + 1;
    const bool made = !change.library().empty() ||
                      (change.copy_of() >= 1 && change.copy_of() <= scene.objects.size());
    return known || (next && made) ? "" : "addObject.object: no object " + std::to_string(id);
}

v1::AddObject state_of_addition(const Scene& scene, const v1::AddObject& change) {
    v1::AddObject state;
    if (change.object() > scene.objects.size()) {
        state = change;
        state.set_removed(true);
        return state;
    }
    const Object& object = scene.objects[change.object() - 1];
    state.set_object(object.id);
    state.set_removed(object.removed);
    if (object.added) {
        state.set_copy_of(object.added->copy_of);
        state.set_library(object.added->library);
        state.set_name(object.added->name);
        to_message(object.added->transform, state.mutable_transform());
    }
    return state;
}

void apply(Scene& scene, const v1::AddObject& change) {
    if (change.object() <= scene.objects.size()) {
        scene.objects[change.object() - 1].removed = change.removed();
    }
}

v1::AddObject numbered(const Scene& scene, const v1::AddObject& request) {
    v1::AddObject result = request;
    result.set_object(static_cast<std::uint32_t>(scene.objects.size()) + 1);
    if (request.copy_of() > 0) {
        const Object& source = scene.objects[request.copy_of() - 1];
        if (request.name().empty()) {
            result.set_name(source.name + " copy");
        }
        if (!request.has_transform()) {
            to_message(source.transform, result.mutable_transform());
        }
    }
    return result;
}

v1::Error problem_of_presence(const Scene& scene, const v1::SceneChanged& change) {
    const std::uint32_t id = subject_of(change).second;
    const bool object = change.has_move_object() || change.has_add_object();
    if (!object && !change.has_set_light() && !change.has_add_luminaire()) {
        return {};
    }
    bool removed = false;
    if (object) {
        removed = scene.objects[id - 1].removed;
    } else if (const auto light = punctual_index(scene, id)) {
        removed = scene.punctual_lights[*light].removed;
    }
    const bool wanted = (change.has_add_object() && !change.add_object().removed()) ||
                        (change.has_add_luminaire() && !change.add_luminaire().removed());
    v1::Error result;
    if (removed != wanted) {
        result.set_code(wanted ? v1::Error::INVALID_ARGUMENT : v1::Error::NOT_FOUND);
        result.set_message((object ? "object " : "light ") + std::to_string(id) +
                           (wanted ? " has not been removed" : " has been removed"));
    }
    return result;
}

namespace {

void describe_one_object(const Scene& scene, std::uint32_t id, v1::SceneChanged& change) {
    describe_object(scene.objects[id - 1], change.add_objects());
    std::set<std::uint32_t> materials;
    for (const Triangle& triangle : scene.triangles) {
        if (triangle.object + 1 == id) {
            materials.insert(triangle.material);
        }
    }
    for (const std::uint32_t material : materials) {
        describe_material(scene, material, change.add_materials());
    }
}

void describe_one_light(const Scene& scene, std::uint32_t id, v1::SceneChanged& change) {
    v1::Scene all;
    describe_lights(scene, &all);
    const auto found = std::find_if(all.lights().begin(), all.lights().end(),
                                    [id](const v1::Light& light) { return light.id() == id; });
    if (found != all.lights().end()) {
        *change.add_lights() = *found;
    }
}

}  // namespace

void name_removal(v1::SceneChanged& change) {
    if (change.has_add_luminaire() && change.add_luminaire().removed()) {
        const std::uint32_t light = change.add_luminaire().light();
        change.mutable_remove_light()->set_light(light);
    } else if (change.has_add_object() && change.add_object().removed()) {
        const std::uint32_t object = change.add_object().object();
        change.mutable_remove_object()->set_object(object);
    }
}

v1::SceneChanged announced(const Scene& scene, const v1::SceneChanged& change) {
    v1::SceneChanged result = change;
    name_removal(result);
    if (result.has_add_object()) {
        describe_one_object(scene, change.add_object().object(), result);
    } else if (result.has_add_luminaire()) {
        describe_one_light(scene, change.add_luminaire().light(), result);
    } else if (change.has_set_light() &&
               (change.set_light().has_photometry() || change.set_light().has_colour_rendering())) {
        describe_one_light(scene, change.set_light().light(), result);
    }
    return result;
}

void describe_luminaires(v1::Scene* message) {
    for (const v1::Light& light : message->lights()) {
        if (light.unit() != v1::Light::LM) {
            continue;
        }
        v1::Luminaire& luminaire = *message->add_luminaires();
        luminaire.set_light(light.id());
        luminaire.set_name(light.name());
        luminaire.set_photometry(light.photometry());
        luminaire.set_flux(light.intensity());
        if (light.has_watts()) {
            luminaire.set_power(light.watts());
        }
        luminaire.set_group(light.group());
    }
}

}  // namespace raybundle
