// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "measure/interval.h"

namespace raybundle {

/// One point of a case of known illuminance.
struct PhotometryPoint {
    std::string name;    ///< case, and where in it
    double exact = 0.0;  ///< in closed form, or by quadrature
    Interval measured;   ///< 95 %
    bool passed = false;

    /// Relative.
    [[nodiscard]] double deviation() const { return measured.value / exact - 1.0; }
};

/// Cases like those of CIE 171:2006, chapter 5, measured by calculation points: point source,
/// rectangles, obstruction, flux, glass, inter-reflection, openings in roof and facade below
/// uniform and standard skies. Needs no GL context; some seconds.
///
/// A point passes where the exact value is at most 1.6 half intervals away (3.4 standard errors:
/// one in 4000 is further by chance), or 0.5 % of it.
std::vector<PhotometryPoint> run_photometry();

}  // namespace raybundle
