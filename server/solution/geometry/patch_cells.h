// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/mesh/patch_mesh.h"

namespace raybundle {

/// Patches of one object that lie near each other and face about the same way, gathered in cells,
/// and these in larger ones: for estimates from too few rays to tell single patches apart. In
/// object space, so that moves leave them as they are.
class PatchCells {
  public:
    explicit PatchCells(const PatchMesh& mesh);

    /// Spreads the flux of each patch over its cell, by area. A cell is divided where at least
    /// `least` rays have met it: whatever its parts got, its flux stays the same. met: rays per
    /// patch.
    [[nodiscard]] std::vector<glm::vec3> spread(std::span<const glm::dvec3> flux,
                                                std::span<const std::uint32_t> met,
                                                std::uint64_t least) const;

  private:
    static constexpr std::uint32_t none = 0xffffffffU;

    std::size_t patches_;
    std::vector<std::uint32_t> parents_;  // patches, then cells; the larger the later
    std::vector<float> areas_;            // likewise, object space
};

}  // namespace raybundle
