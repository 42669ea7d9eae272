// SPDX-License-Identifier: Apache-2.0
#include "solution/direct/lamp_order.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scene/light/lamp_reach.h"

namespace raybundle {

namespace {

/// Grid of about so many cubes over a box, as compact numbers of those that hold points.
std::vector<std::uint32_t> grid_cells(std::span<const glm::vec3> points, const Bounds& box,
                                      std::size_t cells, float edge) {
    const glm::uvec3 counts = glm::max(glm::uvec3(glm::ceil(box.extent() / edge)), glm::uvec3(1));
    std::vector<std::uint64_t> codes;
    codes.reserve(points.size());
    for (const glm::vec3& point : points) {
        const glm::uvec3 at = glm::min(glm::uvec3((point - box.min) / edge), counts - 1U);
        codes.push_back(at.x + std::uint64_t{counts.x} * (at.y + std::uint64_t{counts.y} * at.z));
    }
    std::vector<std::uint64_t> used = codes;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<std::uint32_t> result;
    if (used.size() > cells) {
        return result;
    }
    result.reserve(codes.size());
    for (const std::uint64_t code : codes) {
        result.push_back(static_cast<std::uint32_t>(
            std::lower_bound(used.begin(), used.end(), code) - used.begin()));
    }
    return result;
}

}  // namespace

LampOrder::LampOrder(std::span<const glm::vec3> points, std::size_t lamps) : lamps_(lamps) {
    const std::size_t most = std::clamp<std::size_t>(most_entries / lamps, 1, most_cells);
    Bounds box;
    for (const glm::vec3& point : points) {
        box.add(point);
    }
    const float longest = std::max({box.extent().x, box.extent().y, box.extent().z, 1e-6F});
    // Only cells with points count: from the finest edge that may do, coarser until it does.
    constexpr float coarser = 1.25F;
    for (float edge = longest / std::sqrt(static_cast<float>(most)); cell_of_.empty();
         edge *= coarser) {
        cell_of_ = edge > longest ? std::vector<std::uint32_t>(points.size(), 0)
                                  : grid_cells(points, box, most, edge);
        if (points.empty()) {
            break;
        }
    }
    std::uint32_t cells = 0;
    for (const std::uint32_t cell : cell_of_) {
        cells = std::max(cells, cell + 1);
    }
    boxes_.resize(cells);
    for (std::size_t i = 0; i < points.size(); ++i) {
        boxes_[cell_of_[i]].add(points[i]);
    }
    order_.resize(cells * lamps_);
    weights_.resize(cells * lamps_);
}

std::uint32_t LampOrder::cell_at(const glm::vec3& point) const {
    std::uint32_t nearest = 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t cell = 0; cell < boxes_.size(); ++cell) {
        const glm::vec3 offset = point - glm::clamp(point, boxes_[cell].min, boxes_[cell].max);
        const float square = glm::dot(offset, offset);
        if (square < least) {
            least = square;
            nearest = cell;
        }
    }
    return nearest;
}

void LampOrder::rank(std::span<const PlacedLight> lamps, std::span<const float> ranges) {
    tbb::parallel_for(std::size_t{0}, cells(), [&](std::size_t cell) {
        const auto order = std::span(order_).subspan(cell * lamps_, lamps_);
        const auto weights = std::span(weights_).subspan(cell * lamps_, lamps_);
        std::vector<float> of_lamp(lamps_);
        for (std::size_t k = 0; k < lamps_; ++k) {
            of_lamp[k] = reach_into(lamps[k], ranges[k], boxes_[cell]);
        }
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return of_lamp[a] > of_lamp[b]; });
        for (std::size_t rank = 0; rank < lamps_; ++rank) {
            weights[rank] = of_lamp[order[rank]];
        }
    });
}

std::size_t LampOrder::bytes() const {
    return sizeof(std::uint32_t) * (cell_of_.size() + order_.size()) +
           sizeof(float) * weights_.size();
}

}  // namespace raybundle
