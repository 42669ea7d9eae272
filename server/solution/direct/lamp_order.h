// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// In which order many lamps are looked at, by what each may bring where nothing is in its way:
/// for each cell of a grid over the points that they light all lamps, what may bring most first.
/// No GL. Memory: 8 bytes a cell and lamp, most_entries of them.
class LampOrder {
  public:
    static constexpr std::size_t most_entries = 4U << 20U;
    static constexpr std::size_t most_cells = 4096;

    LampOrder() = default;
    /// Cells of the points, which may be many; lamps: how many there will be, above 0.
    LampOrder(std::span<const glm::vec3> points, std::size_t lamps);

    /// The surface round a point reaches so far. Before rank().
    void include(std::size_t index, const glm::vec3& place) { boxes_[cell_of_[index]].add(place); }

    /// ranges: of the lamps, m, beyond which little is wanted of them; 0: none.
    void rank(std::span<const PlacedLight> lamps, std::span<const float> ranges);

    [[nodiscard]] std::size_t cells() const { return boxes_.size(); }
    [[nodiscard]] std::size_t lamps() const { return lamps_; }
    /// Of each point.
    [[nodiscard]] std::span<const std::uint32_t> cell_of() const { return cell_of_; }
    /// The cell nearest to a point.
    [[nodiscard]] std::uint32_t cell_at(const glm::vec3& point) const;
    /// A point is elsewhere.
    void move_point(std::size_t index, std::uint32_t cell) { cell_of_[index] = cell; }
    /// Lamps in a cell's order.
    [[nodiscard]] std::span<const std::uint32_t> order(std::size_t cell) const {
        return std::span(order_).subspan(cell * lamps_, lamps_);
    }
    /// What they may bring, in the same order; above 0.
    [[nodiscard]] std::span<const float> weights(std::size_t cell) const {
        return std::span(weights_).subspan(cell * lamps_, lamps_);
    }
    [[nodiscard]] std::size_t bytes() const;

  private:
    std::size_t lamps_ = 0;
    std::vector<Bounds> boxes_;  // of the cells' points
    std::vector<std::uint32_t> cell_of_, order_;
    std::vector<float> weights_;
};

}  // namespace raybundle
