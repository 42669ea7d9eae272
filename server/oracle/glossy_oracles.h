// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "oracle/oracles.h"

namespace raybundle {

/// Illuminance, lx, that a lamp sends to a black plate only by way of a glossy floor: lamp and
/// plate lie side by side in one plane that looks down on a metal of the given roughness.
struct GlossyReflection {
    double exact = 0.0;      ///< by quadrature over lamp, floor and plate, of scene/material/brdf.h
    double main_part = 0.0;  ///< the same with a(w_in)/pi in the place of f_r: df_r left out
    double solved = 0.0;
};
GlossyReflection glossy_reflection(float roughness, const OracleSettings& settings);

/// furnace_mean() of a surface with a GGX lobe whose directional albedo is the same at all angles:
/// a white dielectric coat over white Lambert, which together reflect everything, scaled down.
double glossy_furnace_mean(float roughness, float albedo, const OracleSettings& settings);

}  // namespace raybundle
