// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "zones/zone_levels.h"

namespace raybundle {

/// Factors of the power of each zone's patches where shooters are chosen. Chosen by power alone,
/// the patches of a dim room beside a bright one would hardly ever shoot. So half of all shooters
/// are chosen by power, and half by the areas of zones, within a zone by power. No zone has less
/// than half as many as either alone would give it, and a scene of one zone is as it is without.
/// What belongs to no room, as facades and what is hidden below furniture, shoots by its power.
/// zones: before `levels` are applied to the irradiance of their patches.
std::vector<float> shooting_factors(std::span<const ZoneFlux> zones,
                                    std::span<const ZoneLevel> levels);

}  // namespace raybundle
