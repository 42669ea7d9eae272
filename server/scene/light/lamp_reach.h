// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// About the illuminance, lx, that a lamp may bring into a box where nothing is in its way; above
/// 0. range: m, beyond which little is wanted of it; 0: none.
float reach_into(const PlacedLight& lamp, float range, const Bounds& box);

/// The lamps that bring most to a place, where there are many: of each cell of a grid over a box.
class NearLamps {
  public:
    static constexpr std::size_t most = 16;  ///< of a cell

    NearLamps() = default;
    NearLamps(std::span<const PlacedLight> lamps, std::span<const float> ranges,
              const Bounds& bounds);

    /// Indices of lamps, `most` at most. From anywhere, also beside the box.
    [[nodiscard]] std::span<const std::uint32_t> at(const glm::dvec3& place) const;

  private:
    glm::dvec3 low_{0.0}, cells_per_metre_{0.0};
    glm::ivec3 counts_{1};
    std::size_t count_ = 0;  // lamps of each cell
    std::vector<std::uint32_t> lamps_;
};

}  // namespace raybundle
