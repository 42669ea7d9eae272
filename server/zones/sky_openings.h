// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "zones/exchange_rays.h"
#include "zones/zone_partition.h"

namespace raybundle {

/// A box that the sky's light passes on its way to surfaces that see little of it: a window, a
/// door, a roof light, a gap between slats.
struct SkyOpening {
    glm::vec3 corner{0.0F};            ///< m, in the space of the rays
    std::array<glm::vec3, 3> edges{};  ///< m, at right angles
    glm::vec3 inward{0.0F};            ///< unit: where its light goes
    float share = 0.0F;                ///< of the bundles that start in openings; all together 1

    /// m³
    [[nodiscard]] float volume() const {
        return glm::length(edges[0]) * glm::length(edges[1]) * glm::length(edges[2]);
    }
};

struct SkyOpenings {
    std::vector<SkyOpening> openings;
    /// A bit for each patch, 32 a number: it sees little of the sky.
    std::vector<std::uint32_t> sheltered;
    /// m² of the surfaces in each zone that see little of the sky.
    std::vector<double> sheltered_areas;
    /// Of bundles that start in them, if all that such surfaces get came from the sky: the root of
    /// the share that they serve of the scene's surfaces, by area, less what sees the sky anyway.
    float odds = 0.0F;

    /// Of bundles that start in them, among all. sky_share: of the light of sheltered surfaces.
    [[nodiscard]] float probability(float sky_share) const;
};

/// Finds where the light of the sky comes in: where rays from surfaces that see little of it pass
/// between others for the last time (ExchangeRays::last_narrow_place()). Nothing depends on an
/// opening being right but how well light is found through it. lost: all rays that meet no surface;
/// those that meet a sky without light do not count. sent: of each cluster, what ExchangeRay::area
/// of all its rays adds up to. Deterministic.
SkyOpenings find_sky_openings(const ExchangeRays& rays, const ZonePartition& partition,
                              std::span<const ExchangeRay> lost, std::span<const double> sent,
                              std::size_t most);

}  // namespace raybundle
