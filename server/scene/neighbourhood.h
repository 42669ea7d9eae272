// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace raybundle {

/// Surfaces closer than this share of the scene's diameter coincide for bundles: TIE_SHARE of
/// shaders/common/layouts.glsl.
constexpr double coincidence_share = 4e-6;

/// Part of a scene: a triangle, an instance or an object.
struct ScenePiece {
    glm::vec3 centre{0.0F};  ///< of a sphere that holds it, m
    float radius = 0.0F;     ///< of that sphere, m
    float area = 0.0F;       ///< m²
    float emission = 0.0F;   ///< luminance times area, cd
};

/// The part of a scene whose light counts: a ball round the median of its area that holds at least
/// half of the area, grown over whatever follows within three of its radii. What follows later is
/// stray if it would make every bundle at least twice as coarse and if all of it together
/// - is seen from the neighbourhood under less than 3e-5 sr (ten pixels of a picture of 800 x 600
///   with a field of view of 60 degrees), so that it reflects, and hides, next to nothing, and
/// - lights the neighbourhood with less than a thousandth of the flux that is emitted there.
struct Neighbourhood {
    glm::vec3 middle{0.0F};
    double radius = 0.0;              ///< m
    double emission = 0.0;            ///< of its pieces, cd
    std::vector<std::size_t> strays;  ///< numbers of the stray pieces, rising

    /// Whether a piece of it that has moved is stray now.
    [[nodiscard]] bool has_lost(const ScenePiece& piece) const;
};

Neighbourhood find_neighbourhood(std::span<const ScenePiece> pieces);

}  // namespace raybundle
