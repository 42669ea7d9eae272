// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "zones/exchange_rays.h"

namespace raybundle {

using PatchLists = std::vector<std::vector<std::uint32_t>>;

/// Splits clusters whose patches are near each other but see other things: a lamp below a ceiling
/// and inside of a shade, a floor on both sides of a wall. Patches of a cluster stay together where
/// rays connect them, by way of any patches, and where their own rays end in common places, one
/// part of `places`, or in places that others have in common. A patch without any ray joins the
/// part of the nearest patch of its cluster that faces its way. At most `most` clusters come out;
/// no fewer than went in.
PatchLists split_by_sight(const PatchLists& clusters, const PatchLists& places,
                          const ExchangeRays& rays, std::span<const ExchangeRay> traced,
                          std::size_t most);

}  // namespace raybundle
