// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace raybundle {

/// What people know lights by. 0: does not apply, or is not known.
struct LightFigures {
    double flux = 0.0;   ///< luminous, lm
    double peak = 0.0;   ///< largest luminous intensity, cd
    double watts = 0.0;  ///< electrical, as a photometric file states it, W
};

/// Of a lamp as it was loaded: whatever is made of it later, flux and peak follow its intensity.
LightFigures loaded_figures(const Light& light);
LightFigures loaded_figures(const PunctualLight& light);

}  // namespace raybundle
