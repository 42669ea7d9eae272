// SPDX-License-Identifier: Apache-2.0
#include "solution/store/shooting_shares.h"

#include <algorithm>

namespace raybundle {

std::vector<float> shooting_factors(std::span<const ZoneFlux> zones,
                                    std::span<const ZoneLevel> levels) {
    constexpr double by_power = 0.5;  // of both shares the larger loss is the least
    constexpr double darkest = 1e-9;  // of all power: rounding of single precision
    std::vector<double> power;
    double all_power = 0.0;
    double all_area = 0.0;
    for (std::size_t zone = 0; zone < zones.size(); ++zone) {
        const ZoneFlux& z = zones[zone];
        power.push_back(std::max(luminance_of(z.emitted + levels[zone].scale * z.reflected +
                                              z.area * z.albedo * levels[zone].offset),
                                 0.0));
        if (!z.loose) {
            all_power += power.back();
            all_area += z.area;
        }
    }
    std::vector<float> factors(zones.size(), 1.0F);
    for (std::size_t zone = 0; zone < zones.size(); ++zone) {
        if (!zones[zone].loose && power[zone] > darkest * all_power) {
            const double by_area = zones[zone].area / all_area * (all_power / power[zone]);
            factors[zone] = static_cast<float>(by_power + (1.0 - by_power) * by_area);
        }
    }
    return factors;
}

}  // namespace raybundle
