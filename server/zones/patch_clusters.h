// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "zones/exchange_rays.h"

namespace raybundle {

/// Groups patches in `most` clusters, or a few more. Patches of a cluster are near each other, on
/// one side of a wall, and of one object unless a cluster has many. All clusters have about the
/// same number of rays.
std::vector<std::vector<std::uint32_t>> cluster_patches(const ExchangeRays& rays, std::size_t most);

}  // namespace raybundle
