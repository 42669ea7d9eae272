// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/measurement.h"
#include "measure/point_paths.h"
#include "scene/photometry/colour_rendering.h"

namespace raybundle {

/// A lamp that lights an area.
struct ZoneLuminaire {
    std::uint32_t light = 0;  ///< number of the light on the wire
    std::string name;
    double share = 0.0;                               ///< of the light of all lamps there, 0..1
    std::optional<ColourRendering> colour_rendering;  ///< nothing: not known
};

/// Whether the luminaires of an area are asked for where this is measured.
inline bool has_luminaires(Quantity quantity) {
    return quantity == Quantity::horizontal || quantity == Quantity::normal;
}

/// The lamps, without sky and suns, that together bring an area 98 % of the light of all lamps, the
/// strongest first: what comes straight to the points, and unless `direct` what one surface
/// reflects to them, so that luminaires that shine at the ceiling count. Empty where no lamp
/// shines. Of the points 32 at most are looked from, with four paths each: shares are within some
/// per cent.
std::vector<ZoneLuminaire> find_zone_luminaires(const MeasuredScene& scene,
                                                std::span<const CalculationPoint> points,
                                                Quantity quantity, bool direct);

}  // namespace raybundle
