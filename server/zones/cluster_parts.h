// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zones/exchange_rays.h"

namespace raybundle {

using PatchLists = std::vector<std::vector<std::uint32_t>>;

/// Splits clusters whose patches are near each other but see different surfaces: a lamp below a
/// ceiling and inside a shade, a floor on both sides of a wall. Patches of a cluster stay together
/// where rays connect them, by way of any patches, or where their rays end in a common place (one
/// part of `places`), or in places that other patches have in common. A patch without rays joins
/// the part of the nearest patch of its cluster that faces the same way. The number of clusters
/// grows to `most` at most.
PatchLists split_by_sight(const PatchLists& clusters, const PatchLists& places,
                          const ExchangeRays& rays, std::span<const ExchangeRay> traced,
                          std::size_t most);

}  // namespace raybundle
