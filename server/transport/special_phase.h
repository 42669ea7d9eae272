// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solution/gpu_scene.h"
#include "solution/radiance_store.h"
#include "transport/bundle_receiver.h"
#include "transport/iteration_schedule.h"
#include "transport/transfer.h"

namespace raybundle {

/// The special iteration phase (ch. 7.4) for one moved object: every special iteration transfers -L
/// with the object at its old place, then +L with the object at its new place, through one and the
/// same bundle; the averaged increments T_new L - T L join the solution at the end. Lines that meet
/// neither the old nor the new bounds of the object cancel, so only the pixels that can see them
/// are drawn.
class SpecialPhase {
  public:
    static constexpr unsigned perspective_iterations = 6;
    static constexpr unsigned layered_iterations = 2;
    static constexpr unsigned iterations = perspective_iterations + layered_iterations;

    /// The object must already be at its new place (GpuScene::move_object). seed: any number,
    /// different for every change.
    SpecialPhase(const GpuScene& scene, RadianceStore& store, Transfer& transfer,
                 std::uint32_t object, std::uint64_t seed);

    /// One special iteration. The last one also applies the increments.
    void step(std::span<BundleReceiver* const> receivers);
    [[nodiscard]] bool done() const { return next_ >= iterations; }

  private:
    void perspective(const layout::Shooter& shooter, float angle,
                     std::span<BundleReceiver* const> receivers);
    void layered(const RandomisedHalton& numbers, unsigned index,
                 std::span<BundleReceiver* const> receivers);
    [[nodiscard]] TransferSettings transfer_settings(Place place) const;

    const GpuScene& scene_;
    RadianceStore& store_;
    Transfer& transfer_;
    std::uint32_t object_;
    RandomisedHalton numbers_;
    std::array<Bounds, 2> boxes_;  // of the object, now and before, shifted world
    std::vector<layout::Shooter> shooters_;
    unsigned next_ = 0;
};

}  // namespace raybundle
