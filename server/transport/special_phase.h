// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solution/geometry/gpu_scene.h"
#include "solution/store/change_store.h"
#include "solution/store/radiance_store.h"
#include "transport/bundle_receiver.h"
#include "transport/iteration_schedule.h"
#include "transport/scene_change.h"
#include "transport/transfer.h"

namespace raybundle {

/// What a special phase works in.
enum class PhaseKind { moves, surfaces, surfaces_and_sky };

/// The special iteration phase (ch. 7.4),  dL = (Le_new - Le + T_new L - T L) + T_new dL,  in two
/// stages. The first transfers the source term: of a move, -L with the objects at their old places
/// and +L with them at their new places through one and the same bundle, where lines that meet
/// neither cancel and only the pixels that can see either are drawn; of changed surfaces, what they
/// send more than before. The second carries the increments on, T_new dL, each bundle with all that
/// has come in by then. The averaged increments join the solution at the end.
class SpecialPhase {
  public:
    /// Objects are at their new places already (GpuScene::move_objects), or surfaces have changed
    /// (ChangeStore::set_source) and the sky (GpuScene::set_sky_before). seed: any number,
    /// different for every change.
    SpecialPhase(const GpuScene& scene, RadianceStore& store, ChangeStore& change,
                 Transfer& transfer, const SpecialSettings& settings, PhaseKind kind,
                 std::uint64_t seed);

    /// One special iteration. The last one also applies the increments.
    void step(std::span<BundleReceiver* const> receivers);
    [[nodiscard]] bool done() const { return done_; }
    /// Whether its bundles can tell how much there was to correct: one alone, or none, cannot.
    [[nodiscard]] bool informed() const { return !settings_.skipped && bundles_ > 1; }
    /// Samples that the phase has left any mean worth; see weight_beside_unseen(). Once done().
    [[nodiscard]] float most_weight() const { return most_weight_; }
    /// Whether so much light has changed that its levels are to be found before the first frame.
    [[nodiscard]] bool much_changed() const { return much_changed_; }
    /// Bundles of the first stage: chosen while it runs.
    [[nodiscard]] unsigned bundles() const { return bundles_; }

  private:
    [[nodiscard]] unsigned layered_of(unsigned bundles) const;
    [[nodiscard]] bool is_layered(unsigned index, unsigned bundles) const;
    void choose_source_shooters();
    void plan_differences(std::span<BundleReceiver* const> receivers) const;
    void step_source(std::span<BundleReceiver* const> receivers);
    void step_bounce(std::span<BundleReceiver* const> receivers);
    void end_source(std::span<BundleReceiver* const> receivers);
    [[nodiscard]] float weight_beside_unseen(float share) const;
    void finish(std::span<BundleReceiver* const> receivers);
    void move_perspective(const layout::Shooter& shooter, unsigned index,
                          std::span<BundleReceiver* const> receivers);
    void perspective(const layout::Shooter& shooter, unsigned index,
                     std::span<BundleReceiver* const> receivers);
    void layered(unsigned index, std::span<BundleReceiver* const> receivers);
    [[nodiscard]] TransferSettings transfer_settings(Place place) const;
    /// Of a bundle of the first stage, which is drawn with the moved objects at a place.
    [[nodiscard]] TransferSettings difference_settings(Place place, unsigned index) const;
    [[nodiscard]] bool carried(const layout::Shooter& shooter) const;
    [[nodiscard]] ParallelWindow window_of(unsigned index) const;
    [[nodiscard]] std::vector<glm::vec4> shooter_numbers(unsigned first, unsigned count) const;

    const GpuScene& scene_;
    RadianceStore& store_;
    ChangeStore& change_;
    Transfer& transfer_;
    SpecialSettings settings_;
    bool moving_;
    bool sky_changes_;
    RandomisedHalton numbers_;
    std::vector<Bounds> boxes_;  // of the moved objects, now and before, shifted world
    std::vector<layout::Shooter> shooters_;
    unsigned bundles_;  // of the first stage
    float most_weight_ = 1e30F;
    unsigned next_ = 0;          // bundle of the running stage
    unsigned first_number_ = 0;  // of the running stage in the sequences
    bool bouncing_ = false;      // the second stage runs
    bool done_ = false;
    bool much_changed_ = false;
};

}  // namespace raybundle
