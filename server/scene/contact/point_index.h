// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

#include "scene/mix_bits.h"

namespace raybundle {

/// Numbers distinct positions in the order of their first use. Two positions are the same if they
/// are equal bit for bit, -0 counting as 0: what a modeller meant to touch, exporters write equal.
class PointIndex {
  public:
    std::uint32_t id_of(const glm::vec3& position) {
        const glm::vec3 key = position + 0.0F;  // -0 becomes 0
        const auto next = static_cast<std::uint32_t>(points_.size());
        const auto [it, inserted] = ids_.try_emplace(key, next);
        if (inserted) {
            points_.push_back(key);
        }
        return it->second;
    }
    [[nodiscard]] const std::vector<glm::vec3>& points() const { return points_; }

  private:
    struct Hash {
        std::size_t operator()(const glm::vec3& p) const {
            const std::uint64_t xy = (std::uint64_t{std::bit_cast<std::uint32_t>(p.x)} << 32U) |
                                     std::bit_cast<std::uint32_t>(p.y);
            return mix_bits(mix_bits(xy) ^ std::bit_cast<std::uint32_t>(p.z));
        }
    };
    std::unordered_map<glm::vec3, std::uint32_t, Hash> ids_;
    std::vector<glm::vec3> points_;
};

}  // namespace raybundle
