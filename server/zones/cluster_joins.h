// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace raybundle {

/// A zone that sends so much of its light to another one has its level from there after a few
/// bounces, whatever it was.
constexpr float loose_share = 0.25F;

/// A ray from one cluster of patches to another.
struct ClusterRay {
    static constexpr std::uint32_t lost = 0xffffffffU;
    std::uint32_t from = 0;
    std::uint32_t to = lost;
    float area = 0.0F;  ///< m² that it stands for
};

struct ClusterZones {
    unsigned zones = 0;
    std::vector<std::uint32_t>
        zone;  ///< of each cluster; `zones`: too few rays tell it from others
};

/// Joins clusters by average linkage, and takes the loosest joins apart again, into `most` zones at
/// most, of which none sends as much as loose_share of its light to another.
ClusterZones join_clusters(std::size_t clusters, std::span<const ClusterRay> rays, unsigned most);

}  // namespace raybundle
