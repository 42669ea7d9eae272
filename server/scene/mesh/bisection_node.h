// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace raybundle {

/// A triangle on the way from the unrefined to the refined ones. Corners p, q, r with an edge pq
/// that is split at m leave the children (p, m, r) and (m, q, r).
struct BisectionNode {
    static constexpr std::uint32_t no_children = 0xffffffffU;
    std::uint8_t split_edge = 0;              ///< k: from corner k to corner k + 1
    std::uint32_t first_child = no_children;  ///< the second one follows it
};

}  // namespace raybundle
