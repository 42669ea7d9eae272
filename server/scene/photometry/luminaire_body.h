// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "scene/photometry/ies_profile.h"

namespace raybundle {

struct PlacedLight;

/// What an eye sees of a luminaire whose photometric file states its size: the luminous box or
/// cylinder round its position, and a thin black housing on the side that it does not shine to. It
/// is no surface of the scene: it takes no light, sends none to surfaces and hides none of them
/// from each other. shaders/view/view_luminaires.glsl has the same for pictures.
struct LuminaireBody {
    glm::dvec3 position{0.0};   ///< m
    glm::dmat3 axes{1.0};       ///< orthonormal; it shines along -axes[2]
    glm::dvec2 half{0.0};       ///< half of its sizes along axes[0] and axes[1], m
    double low = 0.0;           ///< along axes[2], m: the side that it shines to
    double high = 0.0;          ///< the back of its housing
    glm::dvec3 intensity{0.0};  ///< factor of the profile's
    std::shared_ptr<const IesProfile> profile;

    /// Of a ball round its position that holds it, m.
    [[nodiscard]] double radius() const;
    /// By how much what it touches may lie before it along a ray of that length, m: a luminaire in
    /// the plane of a ceiling is seen.
    [[nodiscard]] double tolerance(double distance) const;
};

/// Nothing where no area is stated.
std::optional<LuminaireBody> body_of(const PlacedLight& light);

/// Where a ray meets a body.
struct LuminaireHit {
    double distance = 0.0;  ///< m
    /// Towards the ray's origin, cd/m²: intensity over projected luminous area. The housing is
    /// black, and so is what a file gives no intensity.
    glm::dvec3 luminance{0.0};
};

/// From outside. direction: unit.
std::optional<LuminaireHit> meet(const LuminaireBody& body, const glm::dvec3& origin,
                                 const glm::dvec3& direction);

}  // namespace raybundle
