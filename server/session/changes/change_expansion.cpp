// SPDX-License-Identifier: Apache-2.0
#include "session/changes/change_expansion.h"

#include <set>
#include <string>
#include <utility>

#include "scene/edit/light_edit.h"
#include "scene/edit/luminaire_edit.h"
#include "scene/object_limits.h"
#include "session/messages/addition_messages.h"
#include "session/messages/light_messages.h"
#include "session/messages/scene_messages.h"

namespace raybundle {
namespace {

Expansion refused(v1::Error::Code code, const std::string& reason) {
    Expansion result;
    result.problem.set_code(code);
    result.problem.set_message(reason);
    return result;
}

Expansion undo_to(std::uint32_t epoch, const ChangeLog& log) {
    const SceneHistory& history = log.history();
    if (auto changes = history.back_to(epoch)) {
        return {std::move(*changes), {}};
    }
    if (epoch > log.epoch()) {
        return refused(v1::Error::INVALID_ARGUMENT, "undo.epoch: there have been only " +
                                                        std::to_string(log.epoch()) + " changes");
    }
    return refused(v1::Error::NOT_FOUND, "undo.epoch: what was before change " +
                                             std::to_string(history.oldest()) +
                                             " is not known any more");
}

/// Why lights cannot join a group; empty where they can.
std::string joining_problem(const v1::SetGroup& group, const Scene& scene) {
    for (const std::uint32_t id : group.lights()) {
        v1::SetLight light;
        light.set_light(id);
        light.set_group(group.group());
        if (const std::string problem = problem_of(scene, light); !problem.empty()) {
            return "setGroup.lights: " + problem;
        }
    }
    return "";
}

/// Has a lamp take so long for what is set of its light.
void fade(const Scene& scene, float fade_seconds, v1::SetLight& light) {
    if (fade_seconds > 0.0F && sets_light(light) && is_lamp(scene, light.light())) {
        light.set_fade_seconds(fade_seconds);
    }
}

/// The newest of several requests for one group counts, by fields.
Expansion set_group(const PendingChange& pending, const Scene& scene) {
    v1::SetGroup sum;
    for (const ClientEvent& request : pending.requests) {
        sum.MergeFrom(request.message.set_group());
    }
    if (const std::string problem = joining_problem(sum, scene); !problem.empty()) {
        return refused(v1::Error::NOT_FOUND, problem);
    }
    const float fade_seconds = pending.requests.back().message.set_group().fade_seconds();
    const std::set<std::uint32_t> joining(sum.lights().begin(), sum.lights().end());
    Expansion result;
    for (const std::uint32_t id : light_numbers(scene)) {
        const LightControl* const control = control_of(scene, id);
        const bool member = control != nullptr && control->group == sum.group();
        if (!member && !joining.contains(id)) {
            continue;
        }
        v1::SetLight& light = *result.changes.emplace_back().mutable_set_light();
        light.set_light(id);
        if (!member) {
            light.set_group(sum.group());
        }
        if (sum.has_dim()) {
            light.set_dim(sum.dim());
        }
        if (sum.has_on()) {
            light.set_on(sum.on());
        }
        fade(scene, fade_seconds, light);
    }
    return result.changes.empty()
               ? refused(v1::Error::NOT_FOUND,
                         "setGroup.group: no light belongs to '" + sum.group() + "'")
               : result;
}

Expansion apply_lighting_scene(const v1::ApplyLightingScene& request, const Scene& scene,
                               const LightingScenes& lighting) {
    auto changes = lighting.changes_to(request.name(), scene);
    if (!changes) {
        return refused(v1::Error::NOT_FOUND,
                       "applyLightingScene.name: no lighting scene '" + request.name() + "'");
    }
    for (v1::SceneChanged& change : *changes) {
        fade(scene, request.fade_seconds(), *change.mutable_set_light());
    }
    return {std::move(*changes), {}};
}

/// All luminaires that shine by the same file as one of them.
Expansion exchange_type(const v1::SetLight& request, const Scene& scene) {
    if (!request.has_photometry()) {
        return refused(v1::Error::INVALID_ARGUMENT, "setLight.sameType: needs photometry");
    }
    if (const std::string problem = problem_of(scene, request); !problem.empty()) {
        return refused(v1::Error::INVALID_ARGUMENT, "setLight." + problem);
    }
    const auto one = punctual_index(scene, request.light());
    if (!one || !scene.punctual_lights[*one].profile) {
        return refused(v1::Error::INVALID_ARGUMENT, "setLight.sameType: light " +
                                                        std::to_string(request.light()) +
                                                        " shines by no photometric file");
    }
    Expansion result;
    for (const std::uint32_t id : light_numbers(scene)) {
        const auto other = punctual_index(scene, id);
        if (other && scene.punctual_lights[*other].profile == scene.punctual_lights[*one].profile) {
            v1::SetLight& light = *result.changes.emplace_back().mutable_set_light();
            light.set_light(id);
            light.set_photometry(request.photometry());
        }
    }
    return result;
}

/// How many luminaires of a field a server has made that ended before the last one.
std::size_t made_before(const PendingChange& pending, std::size_t size, const ChangeLog& log) {
    const v1::ClientMessage& message = pending.requests.front().message;
    const MadeRequest* const made =
        message.has_request_key() ? log.made(message.request_key()) : nullptr;
    return made != nullptr && made->key.parts == size ? made->key.part : 0;
}

Expansion add_field(const PendingChange& pending, const Scene& scene, const ChangeLog& log) {
    const v1::AddLuminaire& request = pending.requests.front().message.add_luminaire();
    const std::string problem = problem_of(scene, from_message(request));
    if (!problem.empty()) {
        return refused(v1::Error::INVALID_ARGUMENT, "addLuminaire." + problem);
    }
    std::vector<v1::AddLuminaire> field = field_of(scene, request);
    const std::size_t made = made_before(pending, field.size(), log);
    const bool one = field.size() == 1;
    field.erase(field.begin(), field.begin() + static_cast<std::ptrdiff_t>(made));
    if (added_lights(scene) + field.size() > max_added_lights) {
        return refused(v1::Error::RESOURCE_EXHAUSTED, "addLuminaire: at most " +
                                                          std::to_string(max_added_lights) +
                                                          " lights can be added, and there are " +
                                                          std::to_string(added_lights(scene)));
    }
    Expansion result;
    result.is_answer = one;
    result.fresh = true;
    result.made = static_cast<std::uint32_t>(made);
    for (const v1::AddLuminaire& luminaire : field) {
        const std::string wrong = problem_of(scene, from_message(luminaire));
        if (!wrong.empty()) {
            return refused(v1::Error::INVALID_ARGUMENT, "addLuminaire." + wrong);
        }
        *result.changes.emplace_back().mutable_add_luminaire() = luminaire;
    }
    return result;
}

Expansion add_one_object(const v1::AddObject& request, const Scene& scene, const PatchMesh& mesh) {
    std::string problem = addition_problem(scene, mesh, from_message(request));
    if (!problem.empty()) {
        const bool full = problem.find("at most") == 0 || problem.find("more than") != problem.npos;
        return refused(full ? v1::Error::RESOURCE_EXHAUSTED : v1::Error::NOT_FOUND,
                       "addObject." + problem);
    }
    Expansion result;
    result.is_answer = true;
    const v1::AddObject object = numbered(scene, request);
    if (object.copy_of() > 0) {
        problem = problem_of(scene, object.copy_of() - 1, from_message(object.transform()));
    }
    if (!problem.empty()) {
        return refused(v1::Error::INVALID_ARGUMENT, "addObject.transform." + problem);
    }
    *result.changes.emplace_back().mutable_add_object() = object;
    return result;
}

}  // namespace

Expansion expand(const PendingChange& pending, const Scene& scene, const PatchMesh& mesh,
                 const ChangeLog& log, const LightingScenes& lighting) {
    const v1::ClientMessage& message = pending.requests.front().message;
    if (message.has_set_group()) {
        return set_group(pending, scene);
    }
    if (message.has_apply_lighting_scene()) {
        return apply_lighting_scene(message.apply_lighting_scene(), scene, lighting);
    }
    if (message.has_add_object()) {
        return add_one_object(message.add_object(), scene, mesh);
    }
    if (message.has_add_luminaire()) {
        return add_field(pending, scene, log);
    }
    if (message.has_set_light()) {
        return exchange_type(message.set_light(), scene);
    }
    return undo_to(message.undo().epoch(), log);
}

}  // namespace raybundle
