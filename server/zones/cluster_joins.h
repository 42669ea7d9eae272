// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace raybundle {

/// A zone that sends a larger share of its light to another zone gets its level from there within
/// some bounces, and is no zone of its own. With a quarter, parts of one room were zones, whose
/// levels had common noise that no pixel's samples show (83 instead of 95 of 100 early error bars
/// were right).
constexpr float loose_share = 0.1F;

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
