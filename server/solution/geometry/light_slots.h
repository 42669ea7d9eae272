// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// The lights without extent of a scene as tables of the GPU have them: in one order while some
/// are added and removed. Those of the file and of the sky come first (one with a disc as several
/// without, one with a large opening as its quarters), then slots for those that have been added;
/// an empty slot is a dark light.
class LightSlots {
  public:
    /// patch_length: side of a square patch of mean size, m. Shadows of an opening that is no
    /// larger are finer than patches, and are cast from its middle; others from four points, while
    /// so many lights have maps.
    LightSlots(const Scene& scene, double patch_length);

    /// Whether the scene's lights as they are now have room.
    [[nodiscard]] bool fit(const Scene& scene) const;
    /// Takes them over. Requires fit(). A light keeps its slot, and an empty slot keeps the place
    /// of the light that was there.
    void update(const Scene& scene);
    [[nodiscard]] const std::vector<PunctualLight>& lights() const { return lights_; }
    /// Whether lights have been added, or may be: these have profiles.
    [[nodiscard]] bool any_slots() const { return !numbers_.empty(); }

  private:
    [[nodiscard]] bool is_large(const PunctualLight& light) const;
    [[nodiscard]] std::vector<PunctualLight> lights_of_file(const Scene& scene) const;
    [[nodiscard]] bool any_large(const std::vector<const PunctualLight*>& lights) const;
    void put(std::size_t slot, const PunctualLight& light);
    void empty(std::size_t slot);

    double patch_length_ = 0.0;
    bool divides_ = true;          // large openings
    std::size_t slot_lights_ = 1;  // in a slot
    std::size_t fixed_ = 0;
    std::vector<PunctualLight> lights_;
    std::vector<std::uint32_t> numbers_;  // of the lights in the slots; 0: empty
};

/// Whether some of them shine by photometric files.
bool any_profile(const std::vector<PunctualLight>& lights);

}  // namespace raybundle
