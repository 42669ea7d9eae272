// SPDX-License-Identifier: Apache-2.0
// Integrals over the outgoing hemisphere, by evenly placed directions instead of random ones.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "scene/material/brdf.h"

namespace raybundle {

/// A point of the unit disc for lobe_direction() and cosine_direction(), with its share of the
/// area.
struct DiscPoint {
    glm::vec2 disc;
    float weight;
};

/// Points of one half of the disc, y > 0; their weights sum to 1, since the other half gives mirror
/// images.
std::span<const DiscPoint> half_disc_lattice();

/// Directional albedo of a specular lobe, split by Schlick's Fresnel term ("split sum", Karis 2013,
/// "Real Shading in Unreal Engine 4"): f0 * scale + f90 * bias. scale + bias <= 1.
struct LobeAlbedo {
    float scale = 0.0F;
    float bias = 0.0F;
};

/// The albedo for light from an angle, by quadrature: 0.2 % off at most; below a clear coat what is
/// left of it. Not for LobeKind::none.
LobeAlbedo integrate_albedo(const SpecularLobe& lobe, float cosine);

/// The direction in the plane y = 0 at an angle to the normal; a hair above the horizon at least.
glm::vec3 direction_at(float cosine);

}  // namespace raybundle
