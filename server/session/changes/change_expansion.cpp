// SPDX-License-Identifier: Apache-2.0
#include "session/changes/change_expansion.h"

#include <set>
#include <string>
#include <utility>

#include "scene/light_edit.h"
#include "session/messages/light_messages.h"

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

/// The newest of several requests for one group counts, by fields.
Expansion set_group(const PendingChange& pending, const Scene& scene) {
    v1::SetGroup sum;
    for (const ClientEvent& request : pending.requests) {
        sum.MergeFrom(request.message.set_group());
    }
    if (const std::string problem = joining_problem(sum, scene); !problem.empty()) {
        return refused(v1::Error::NOT_FOUND, problem);
    }
    const std::set<std::uint32_t> joining(sum.lights().begin(), sum.lights().end());
    Expansion result;
    for (std::uint32_t id = 1; id <= light_count(scene); ++id) {
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
    }
    return result.changes.empty()
               ? refused(v1::Error::NOT_FOUND,
                         "setGroup.group: no light belongs to '" + sum.group() + "'")
               : result;
}

}  // namespace

Expansion expand(const PendingChange& pending, const Scene& scene, const ChangeLog& log,
                 const LightingScenes& lighting) {
    const v1::ClientMessage& message = pending.requests.front().message;
    if (message.has_set_group()) {
        return set_group(pending, scene);
    }
    if (message.has_apply_lighting_scene()) {
        const std::string& name = message.apply_lighting_scene().name();
        auto changes = lighting.changes_to(name, scene);
        return changes ? Expansion{std::move(*changes), {}}
                       : refused(v1::Error::NOT_FOUND,
                                 "applyLightingScene.name: no lighting scene '" + name + "'");
    }
    return undo_to(message.undo().epoch(), log);
}

}  // namespace raybundle
