// SPDX-License-Identifier: Apache-2.0
// How the solver takes over changes of the scene.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scene/edit/surface_edit.h"
#include "transport/solver.h"

namespace raybundle {

namespace {

constexpr float no_limit = 1e30F;
/// Where gloss has changed, the phase knows only what a Lambert surface of the same albedo would
/// send: every mean is then worth so many samples at most.
constexpr float glossy_weight = 4.0F;
/// Emission may leave the unit of radiance by this factor before another unit is chosen: sums in
/// fixed point and half floats have room for it.
constexpr float unit_range = 64.0F;
/// Samples that what punctual lights bring anew is worth, against those taken with their light
/// before.
constexpr float first_shot_weight = 1.0F;
/// Samples that any mean is worth after all light was carried elsewhere, whatever the few bundles
/// of the phase say: those that have missed the lamp leave its light where it was.
constexpr float carried_light_weight = 1.0F;
/// A change that is settled to less than this is still being worked in when the next one comes.
constexpr double settled_enough = 0.95;
/// Samples that the iterate is worth after any change, so that its steps are large again.
constexpr float iterate_age_after_change = 31.0F;

/// Whether an emitter has come or gone among the patches.
bool emitters_differ(std::span<const glm::vec3> before, std::span<const glm::vec3> after) {
    for (std::size_t i = 0; i < before.size(); ++i) {
        if ((before[i] == glm::vec3(0.0F)) != (after[i] == glm::vec3(0.0F))) {
            return true;
        }
    }
    return false;
}

}  // namespace

ChangeStore& Solver::change_store() {
    if (!change_store_) {
        change_store_.emplace(scene_, store_);
    }
    return *change_store_;
}

/// Whether another change comes before the last one is worked in.
bool Solver::unsettled() const {
    return changes_ > 0 && statistics_.settled < settled_enough;
}

/// What has been kept over the last change and what has come in since are one again.
void Solver::begin_change() {
    store_.bind();
    store_.serve();
    store_.forget_kept();
    store_.checkpoint(unsettled());
}

void Solver::note_change() {
    group_.clear();
    group_next_ = 0;
    since_change_ = 0;
    next_slopes_ = 0;
    limit_iterate_age(iterate_age_after_change);
    statistics_.settled = 0.0;
    zones_.interrupt();
    store_.forget_scatter();
    mix_.forget();
    ++changes_;
}

void Solver::start_phase(PhaseKind kind, float most_weight) {
    SpecialSettings special = settings_.special;
    if (kind == PhaseKind::moves) {  // each further object half as many more bundles
        const auto objects = static_cast<unsigned>(scene_.moved_bounds().size() / 2);
        special.bundles += special.bundles * (std::max(objects, 1U) - 1) / 2;
    }
    special.most_weight = std::min(special.most_weight, most_weight);
    phase_.emplace(scene_, store_, change_store(), *coarse_, special, kind,
                   mix_bits(settings_.seed) + changes_);
}

void Solver::move_object(std::uint32_t object, const glm::mat4& world_from_object,
                         std::span<BundleReceiver* const> receivers) {
    const ObjectMove moves[] = {{object, world_from_object}};
    move_objects(moves, receivers);
}

void Solver::move_objects(std::span<const ObjectMove> moves,
                          std::span<BundleReceiver* const> receivers) {
    if (moves.size() > MOST_MOVED) {
        throw std::invalid_argument("more objects than one phase moves");
    }
    begin_change();
    store_.begin_moves(moves);
    for (BundleReceiver* receiver : receivers) {
        receiver->begin_moves();
    }
    scene_.move_objects(moves);
    zones_.objects_moved();
    for (const ObjectMove& move : moves) {
        store_.turn_gloss(move.object, scene_.now_from_before(move.object));
    }
    store_.follow_sizes();
    store_.reshoot(first_shot_weight);
    restart_caustics();
    for (BundleReceiver* receiver : receivers) {
        receiver->begin_special();
    }
    note_change();
    const float share = carried_light_.moved_share(moves, scene_.moved_bounds(), scene_.diameter());
    start_phase(PhaseKind::moves, share > 0.0F ? carried_light_weight / (share * share) : no_limit);
}

/// Lamps, or what they shine through, have changed.
void Solver::restart_caustics() {
    if (caustics_) {
        caustics_->restart();
        store_.bind();
    }
}

void Solver::rehearse_move(std::uint32_t object, const glm::mat4& world_from_object,
                           std::span<BundleReceiver* const> receivers) {
    if (changes_ > 0) {
        return;
    }
    move_object(object, world_from_object, receivers);
    while (correcting()) {
        step(receivers);
    }
    zones_.set_iterate_age(iterate_age());
    store_.refresh_power();  // judges what was kept
    store_.serve();
    changes_ = 0;
    special_bundles_ = 0;
    store_.forget_checkpoint();
    store_.forget_kept();
    store_.bind();
    refresh_statistics();
}

/// Chooses another unit of radiance where emission is far from the present one. scale: what the
/// solution is multiplied by, in the present unit; becomes what it is in the new one.
void Solver::adapt_unit(const Scene& scene, const PatchMesh& mesh, glm::vec3& scale) {
    const float largest = GpuScene::largest_emission(scene, mesh);
    const float unit = scene_.radiance_unit();
    if (largest <= 0.0F || (largest < unit * unit_range && largest * unit_range > unit)) {
        return;
    }
    const float next = GpuScene::unit_for(largest);
    scale *= unit / next;
    scene_.set_radiance_unit(next, scene, mesh);
}

bool Solver::any_glossy(std::span<const std::uint32_t> materials) const {
    return std::any_of(materials.begin(), materials.end(), [this](std::uint32_t material) {
        return scene_.reflectance().glossy(material);
    });
}

/// The surfaces have changed: from those that change_store() remembers to those of scene_.
void Solver::work_in(const SurfaceChange& change, std::span<BundleReceiver* const> receivers) {
    store_.bind();
    if (change.scale != glm::vec3(1.0F)) {
        change_store().scale(change.scale);
    }
    change_store().set_source(change.scale, change.reflecting);
    restart_caustics();
    for (BundleReceiver* receiver : receivers) {
        receiver->begin_surfaces(change.scale, change.reflecting, change.redraw);
    }
    note_change();
    if (change.transfer) {
        start_phase(change.sky ? PhaseKind::surfaces_and_sky : PhaseKind::surfaces,
                    change.glossy ? glossy_weight : no_limit);
        return;
    }
    for (BundleReceiver* receiver : receivers) {
        receiver->end_special(1.0F, no_limit);
    }
    store_.bind();
    store_.keep_light();
    refresh_statistics();
}

void Solver::change_surfaces(const Scene& scene, PatchMesh& mesh,
                             std::span<const std::uint32_t> materials,
                             std::span<const std::uint32_t> reflecting,
                             std::span<BundleReceiver* const> receivers) {
    const std::vector<glm::vec3> emitted = mesh.emission;
    const std::vector<PunctualLight> punctual = scene_.punctual_lights();
    const Sky sky = scene_.sky();
    refresh_surfaces(scene, materials, mesh);
    begin_change();
    store_.remember_first_shot(store_);
    change_store().remember_surfaces(scene_);
    scene_.update_lights(scene);
    store_.begin_lights();
    for (BundleReceiver* receiver : receivers) {
        receiver->begin_lights();
    }
    store_.bind();
    const Emission before{emitted, punctual, sky};
    const Emission after{mesh.emission, scene_.punctual_lights(), scene_.sky()};
    SurfaceChange change;
    change.scale = common_scale(scene, mesh, before, after);
    change.sky = sky_left(sky, scene_.sky(), change.scale);
    scene_.set_sky_before(sky, change.scale);
    change.reflecting = reflecting;
    change.transfer = !reflecting.empty() || anything_left(before, after, change.scale);
    change.redraw = !reflecting.empty() || emitters_differ(emitted, mesh.emission);
    change.glossy = any_glossy(reflecting);
    scene_.update_surfaces(scene, mesh, materials);
    zones_.surfaces_changed(mesh);
    change.glossy = change.glossy || any_glossy(reflecting);
    adapt_unit(scene, mesh, change.scale);
    store_.renew_first_shot(reflecting);
    carried_light_.update(scene, mesh);
    if (caustics_) {
        caustics_->update(scene, materials, mesh.emission);
        caustics_->scale(change.scale);
    }
    work_in(change, receivers);
}

void Solver::continue_from(const Solver& other, const Scene& scene, const PatchMesh& mesh) {
    iterations_ = other.iterations_;
    iterate_age_ = other.iterate_age_;
    changes_ = std::max<std::uint64_t>(other.changes_, 1);
    statistics_ = other.statistics_;
    other.store_.bind();
    other.store_.serve();
    if (const float unit = other.scene_.radiance_unit(); unit != scene_.radiance_unit()) {
        scene_.set_radiance_unit(unit, scene, mesh);
        store_.renew_first_shot({});
        restart_caustics();
    }
    store_.bind();
    store_.adopt(other.store_);
    if (caustics_) {
        caustics_->adopt(other.caustics_.get());
        caustics_->refresh();
        store_.bind();
    }
    zones_.set_iterate_age(iterate_age());
    store_.refresh_power();
    group_.clear();
    group_next_ = 0;
}

void Solver::take_over(const Solver& other, std::span<const std::uint32_t> reflecting,
                       std::span<BundleReceiver* const> receivers) {
    iterations_ = other.iterations_;
    iterate_age_ = other.iterate_age_;
    changes_ = other.changes_;
    statistics_ = other.statistics_;
    other.store_.bind();
    other.store_.serve();
    store_.adopt(other.store_);
    begin_change();
    change_store().remember_surfaces(other.scene_);
    store_.remember_first_shot(other.store_);
    SurfaceChange change;
    change.scale = glm::vec3(other.scene_.radiance_unit() / scene_.radiance_unit());
    change.sky = sky_left(other.scene_.sky(), scene_.sky(), glm::vec3(1.0F));
    scene_.set_sky_before(other.scene_.sky(), glm::vec3(1.0F));
    change.reflecting = reflecting;
    change.glossy = any_glossy(reflecting);
    if (caustics_) {
        caustics_->adopt(other.caustics_.get());
        caustics_->scale(change.scale);
    }
    work_in(change, receivers);
}

}  // namespace raybundle
