// SPDX-License-Identifier: Apache-2.0
// Changes of lights, materials and daylight, and lamps that fade.
#include <algorithm>
#include <utility>

#include "scene/edit/daylight_edit.h"
#include "scene/edit/light_edit.h"
#include "scene/edit/surface_edit.h"
#include "session/changes/change_coordinator.h"
#include "session/changes/changed_materials.h"
#include "session/messages/daylight_messages.h"

namespace raybundle {

namespace {

/// What the lamps of changes shine with before these.
LampOutputs outputs_before(const Scene& scene, const std::vector<PendingChange>& pending) {
    LampOutputs outputs;
    for (const PendingChange& p : pending) {
        const std::uint32_t light = p.change.set_light().light();
        if (p.change.has_set_light() && is_lamp(scene, light)) {
            outputs[light] = lamp_output(scene, light);
        }
    }
    return outputs;
}

}  // namespace

/// Whether somebody holds the slider of the day, or an animation plays: all is redrawn at every
/// step, which takes its time.
bool ChangeCoordinator::goes_on(const std::vector<PendingChange>& pending) const {
    return std::any_of(pending.begin(), pending.end(), [this](const PendingChange& p) {
        return p.change.has_animation() || (p.change.has_set_daylight() && day_held_);
    });
}

/// Keeps of `pending` what could be saved. Without any changes: only what fades goes on.
bool ChangeCoordinator::start_surfaces(std::vector<PendingChange>& pending) {
    LiveScene& live = parts_.scene;
    LightFades& fades = live.fades();
    const TimePoint now = parts_.policy.clock().now();
    const bool asked = !pending.empty();
    LampOutputs shown;
    ChangedMaterials changed;
    {
        const ShownLamps as_shown(live.scene(), fades);
        changed.look(live.scene(), pending, fades.lamps());
        shown = outputs_before(live.scene(), pending);
    }
    const std::vector<float> cones = outer_cones(live.scene());
    const bool held = goes_on(pending);
    queue_.put_back(recorder_.record(pending));
    if (asked && pending.empty()) {
        return false;
    }
    for (const PendingChange& made : pending) {
        fades.follow(made.change, shown, live.scene(), now);
    }
    const std::vector<std::uint32_t> faded = fades.advance(now);
    fade_waits_ = false;
    const ShownLamps as_shown(live.scene(), fades);
    changed.look_again(live.scene(), pending, faded);
    const bool covered =
        same_cones(live.scene(), cones) && live.solver().covers_lights(live.scene()) &&
        std::all_of(
            changed.reflecting().begin(), changed.reflecting().end(),
            [&](std::uint32_t material) { return live.solver().covers(live.scene(), material); });
    if (covered) {
        const bool on_the_way = held || fades.running();
        gather_all();
        begin_phase(live.solver(), on_the_way);
        if (on_the_way) {
            shrink_for_drag();
        }
        live.solver().change_surfaces(live.scene(), live.mesh(), changed.all(),
                                      changed.reflecting(), parts_.receivers.list());
    } else {
        refresh_surfaces(live.scene(), changed.all(), live.mesh());
        replan(changed.reflecting());
    }
    return true;
}

/// Daylight comes with its sky and suns undimmed: that they were not so is a change of its own,
/// which an undo takes back.
void ChangeCoordinator::undim_sky(std::vector<PendingChange>& pending) const {
    const Scene& scene = parts_.scene.scene();
    if (!daylight_dimmed(scene)) {
        return;
    }
    v1::SetDaylight sky;
    describe_sky_lights(scene, &sky);
    for (const v1::Light& light : sky.lights()) {
        PendingChange undimmed;
        undimmed.change.set_by(pending.back().change.by());
        v1::SetLight& set = *undimmed.change.mutable_set_light();
        set.set_light(light.id());
        set.set_on(true);
        set.set_intensity(light.loaded_intensity());
        *set.mutable_colour() = light.loaded_colour();
        pending.insert(pending.end() - 1, std::move(undimmed));
    }
}

/// Whether fading lamps are to be shown as they are by now, before the next change.
bool ChangeCoordinator::fades_are_next() const {
    return (queue_.empty() || fade_waits_) &&
           parts_.scene.fades().due(parts_.policy.clock().now(), !parts_.viewers.empty());
}

/// A step of all fades: no change of its own, but worked in as one, and at the same pace.
void ChangeCoordinator::step_fades() {
    const TimePoint begun = parts_.policy.clock().now();
    std::vector<PendingChange> none;
    start_surfaces(none);
    note_shown();
    parts_.policy.note_beginning(parts_.policy.clock().ms_since(begun));
    end_change();
}

}  // namespace raybundle
