// SPDX-License-Identifier: Apache-2.0
// Changes for which another solver takes over.
#include <spdlog/spdlog.h>

#include <mutex>
#include <utility>

#include "bundle/low_discrepancy.h"
#include "gpu/egl_context.h"
#include "scene/gltf/gltf_loader.h"
#include "session/changes/change_coordinator.h"
#include "session/messages/addition_messages.h"

namespace raybundle {

/// Another solver of the scene as it is now.
std::unique_ptr<Solver> ChangeCoordinator::plan_anew(std::unique_ptr<ViewPrograms>& programs) {
    LiveScene& live = parts_.scene;
    SolverSettings settings = live.solver_settings();
    settings.seed = mix_bits(settings.seed + ++replans_);
    auto next = std::make_unique<Solver>(live.scene(), live.mesh(), settings);
    programs = std::make_unique<ViewPrograms>(next->scene());
    return next;
}

/// A material calls for shaders that the scene did not need so far: another solver takes over the
/// solution.
void ChangeCoordinator::replan(std::span<const std::uint32_t> reflecting) {
    LiveScene& live = parts_.scene;
    std::unique_ptr<ViewPrograms> programs;
    std::unique_ptr<Solver> next = plan_anew(programs);
    parts_.pictures.renew(*next, *programs);
    gather_all();
    begin_phase(*next, false);
    next->take_over(live.solver(), reflecting, parts_.receivers.list());
    live.replace(std::move(next), std::move(programs));
    spdlog::info("shaders have been planned anew for a change of the scene");
}

/// An object that has never been there: a solver of the scene with it, removed still, goes on where
/// this one is; then it comes from nowhere. False: nothing has changed, and it is answered.
bool ChangeCoordinator::start_growth(std::vector<PendingChange>& changes) {
    const PendingChange& pending = changes.front();
    LiveScene& live = parts_.scene;
    const GrowthMark mark = mark_growth(live.scene());
    PatchMesh mesh = live.mesh();
    const auto undo = [&] {
        const std::lock_guard lock(live.geometry_mutex());
        take_back(live.scene(), mark);
        live.mesh() = std::move(mesh);
    };
    std::unique_ptr<Solver> next;
    std::unique_ptr<ViewPrograms> programs;
    v1::Error::Code code = v1::Error::INVALID_ARGUMENT;
    std::string problem;
    try {
        const std::lock_guard lock(live.geometry_mutex());
        const ShownLamps as_shown(live.scene(), live.fades());
        add_object(live.scene(), live.mesh(), from_message(pending.change.add_object()));
        next = plan_anew(programs);
    } catch (const SceneError& error) {
        problem = error.reason();
    } catch (const GpuError& error) {
        spdlog::error("an object cannot be added: {}", error.what());
        code = v1::Error::RESOURCE_EXHAUSTED;
        problem = "the server has no memory for it";
    } catch (const std::exception& error) {  // Embree, or no memory
        spdlog::error("an object cannot be added: {}", error.what());
        code = v1::Error::RESOURCE_EXHAUSTED;
        problem = "the server cannot hold it";
    }
    if (!problem.empty()) {
        undo();
        const std::string field =
            pending.change.add_object().library().empty() ? "addObject: " : "addObject.library: ";
        recorder_.refuse(pending, code, field + problem);
        return false;
    }
    queue_.put_back(recorder_.record(changes));
    if (changes.empty()) {
        undo();
        return false;
    }
    parts_.pictures.renew(*next, *programs);
    gather_all();
    begin_phase(*next, false);
    const std::uint32_t object = changes.front().change.add_object().object() - 1;
    const ShownLamps as_shown(live.scene(), live.fades());
    next->continue_from(live.solver(), live.scene(), live.mesh());
    next->move_object(object, live.scene().objects[object].world_from_object(),
                      parts_.receivers.list());
    live.replace(std::move(next), std::move(programs));
    return true;
}

}  // namespace raybundle
