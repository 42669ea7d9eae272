// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "zones/exchange_rays.h"

namespace raybundle {

/// Patches in `most` clusters, or a few more: near each other, on one side of a wall, and of one
/// object where there are few in a cluster. Each has about as many rays.
std::vector<std::vector<std::uint32_t>> cluster_patches(const ExchangeRays& rays, std::size_t most);

}  // namespace raybundle
