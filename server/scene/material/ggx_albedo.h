// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/material/lobe_quadrature.h"

namespace raybundle {

/// Smallest roughness that is told apart: below, alpha = roughness^2 is a mirror's in float.
constexpr float min_roughness = 0.045F;

/// Directional albedo of a GGX lobe at an angle, interpolated in a table that is integrated on
/// first use (about 0.2 s): 0.5 % off at most, of f0 * scale + f90 * bias with f0 >= 0.04 f90.
LobeAlbedo ggx_albedo(float alpha, float cosine);

/// The same at a node of reflectance_nodes.h, where only the alpha is interpolated.
LobeAlbedo ggx_albedo_at_node(float alpha, int node);

/// Mean over the hemisphere, 2 * integral of ggx_albedo() cos dcos: exact for its interpolation.
LobeAlbedo ggx_mean_albedo(float alpha);

}  // namespace raybundle
