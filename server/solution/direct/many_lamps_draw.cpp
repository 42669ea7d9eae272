// SPDX-License-Identifier: Apache-2.0
// Lamps that are drawn by what they may bring: for patches among those that have not been looked
// at, and as proposals of glossy patches.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "scene/mix_bits.h"
#include "solution/direct/many_lamps.h"

namespace raybundle {

namespace {

/// A number in [0, 1) of two.
float random_number(std::uint32_t a, std::uint32_t b) {
    return static_cast<float>(mix_bits(std::uint64_t{a} << 32U | b) >> 40U) * 0x1p-24F;
}

/// Numbers drawn in proportion to weights, whose cumulative sums these are: one in each of so many
/// strata. Calls take(stratum, number).
template <typename Take>
void draw_in_strata(const std::vector<double>& sums, std::size_t strata, double offset,
                    const Take& take) {
    for (std::size_t k = 0; k < strata; ++k) {
        const double at =
            (static_cast<double>(k) + offset) / static_cast<double>(strata) * sums.back();
        const auto found =
            static_cast<std::size_t>(std::upper_bound(sums.begin(), sums.end(), at) - sums.begin());
        take(k, std::min(found, sums.size() - 1));
    }
}

}  // namespace

/// Lamps for the patches of a chunk among those that have not been looked at after this row, by
/// what they may bring, in strata; and whether they reach a point of the patch.
void ManyLamps::draw_chances(std::size_t patches, const Pass& pass, std::size_t first) {
    const std::size_t known = std::min(rank_ + LAMP_SLOTS, lamps_);
    std::vector<glm::uvec2> drawn(patches * LAMP_CHANCES, glm::uvec2(no_lamp, 0U));
    const std::size_t points = patches * pass.parts;
    std::vector<std::uint32_t> rows(points * LAMP_SLOTS, no_lamp);
    std::vector<LampPoint> own(points_.begin(),
                               points_.begin() + static_cast<std::ptrdiff_t>(points));
    for (std::size_t i = 0; i < points; ++i) {
        own[i].cell = static_cast<std::uint32_t>(i) | (own[i].cell & LampPoint::moved);
    }
    if (known < lamps_) {
        std::vector<double> sums;
        std::uint32_t cell_of_sums = LampPoint::no_cell;
        for (std::size_t i = 0; i < patches; ++i) {
            const std::uint32_t patch = patch_order_[first + i];
            const std::uint32_t cell = order_.cell_of()[patch];
            if (cell != cell_of_sums) {
                const auto weights = order_.weights(cell).subspan(known);
                sums.assign(weights.begin(), weights.end());
                std::partial_sum(sums.begin(), sums.end(), sums.begin());
                cell_of_sums = cell;
            }
            const double offset = static_cast<double>(random_number(patch, step_));
            const auto take = [&](std::size_t k, std::size_t found) {
                const double weight =
                    sums.back() /
                    (LAMP_CHANCES * static_cast<double>(order_.weights(cell)[known + found]));
                const std::uint32_t lamp = order_.order(cell)[known + found];
                drawn[i * LAMP_CHANCES + k] = {
                    lamp, std::bit_cast<std::uint32_t>(static_cast<float>(weight))};
                rows[(i * pass.parts + k % pass.parts) * LAMP_SLOTS + k] = lamp;
            };
            draw_in_strata(sums, LAMP_CHANCES, offset, take);
        }
    }
    std::vector<std::uint32_t> lit(points, 0);
    Pass plain = pass;
    plain.boxes = {};
    ask(own, rows, plain, lit);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const std::size_t k = i % LAMP_CHANCES;
        if ((lit[i / LAMP_CHANCES * pass.parts + k % pass.parts] >> k & 1U) == 0) {
            drawn[i].y = 0;
        }
    }
    chances_.write<glm::uvec2>(drawn, 0);
}

void ManyLamps::draw_proposals(std::uint32_t seed) {
    if (proposals_.bytes() == 0) {
        return;
    }
    // All at first, and then one in so many of the cells: there are groups enough.
    constexpr std::size_t stride = 16;
    const bool all = drawn_.empty();
    drawn_.resize(order_.cells() * LAMP_SLOTS);
    tbb::parallel_for(std::size_t{0}, order_.cells(), [&](std::size_t cell) {
        if (!all && (cell + seed) % stride != 0) {
            return;
        }
        const auto weights = order_.weights(cell);
        // What has been looked at and reaches nothing here brings nothing.
        const std::size_t known = std::min(rank_, lamps_);
        std::vector<double> sums(lamps_);
        double sum = 0.0;
        for (std::size_t rank = 0; rank < lamps_; ++rank) {
            const bool dark = rank < known && reaches_[cell * lamps_ + rank] == 0;
            sum += dark ? 0.0 : static_cast<double>(weights[rank]);
            sums[rank] = sum;
        }
        const auto offset =
            static_cast<double>(random_number(static_cast<std::uint32_t>(cell), seed));
        draw_in_strata(sums, LAMP_SLOTS, offset, [&](std::size_t k, std::size_t rank) {
            const double weight = sum / static_cast<double>(weights[rank]);
            drawn_[cell * LAMP_SLOTS + k] = {
                order_.order(cell)[rank], std::bit_cast<std::uint32_t>(static_cast<float>(weight))};
        });
    });
    proposals_.write<glm::uvec2>(drawn_, 0);
}

}  // namespace raybundle
