// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/mix_bits.h"

namespace raybundle {

/// Numbers distinct positions in the order of their first use. Two positions are the same if they
/// are equal bit for bit, -0 counting as 0: what a modeller meant to touch, exporters write equal.
class PointIndex {
  public:
    std::uint32_t id_of(const glm::vec3& position) {
        if (4 * (points_.size() + 1) > 3 * slots_.size()) {
            grow();
        }
        const glm::vec3 key = position + 0.0F;  // -0 becomes 0
        std::uint32_t& slot = slot_of(key);
        if (slot == none) {
            slot = static_cast<std::uint32_t>(points_.size());
            points_.push_back(key);
        }
        return slot;
    }
    [[nodiscard]] const std::vector<glm::vec3>& points() const { return points_; }

  private:
    static constexpr std::uint32_t none = 0xffffffffU;
    static constexpr std::size_t least_slots = 16;

    static std::uint64_t hash(const glm::vec3& p) {
        const std::uint64_t xy = (std::uint64_t{std::bit_cast<std::uint32_t>(p.x)} << 32U) |
                                 std::bit_cast<std::uint32_t>(p.y);
        return mix_bits(mix_bits(xy) ^ std::bit_cast<std::uint32_t>(p.z));
    }
    /// The slot of a position, or the free one where it belongs.
    std::uint32_t& slot_of(const glm::vec3& key) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = hash(key) & mask;
        while (slots_[at] != none && points_[slots_[at]] != key) {
            at = (at + 1) & mask;
        }
        return slots_[at];
    }
    void grow() {
        slots_.assign(std::max(2 * slots_.size(), least_slots), none);
        for (std::uint32_t i = 0; i < points_.size(); ++i) {
            slot_of(points_[i]) = i;
        }
    }

    std::vector<std::uint32_t> slots_;  // open addressing, a power of two
    std::vector<glm::vec3> points_;
};

}  // namespace raybundle
