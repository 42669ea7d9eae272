// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "zones/exchange_rays.h"

namespace raybundle {

constexpr unsigned max_zones = 64;

/// Zones of a scene: patches that send most of their light to each other, as those of a room do.
struct ZonePartition {
    unsigned count = 0;
    std::vector<std::uint32_t> zone;  ///< of each patch, below count
    /// Holds patches that belong to no room: facades, surfaces that hardly anything lights,
    /// surfaces with too few rays. Its light has no level of its own.
    std::optional<unsigned> loose;
    /// Of each patch, below clusters: patches near each other that see the same things.
    std::vector<std::uint32_t> cluster;
    unsigned clusters = 0;
};

/// Merges small clusters of patches (by place, side and object), those first that exchange the
/// largest share of their light, until there are max_zones zones at most and none sends
/// `loose_share` of its light to another one. The zones are the slow modes of the transport.
/// Deterministic.
ZonePartition find_zones(const ExchangeRays& rays, std::span<const ExchangeRay> traced);

}  // namespace raybundle
