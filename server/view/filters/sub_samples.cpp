// SPDX-License-Identifier: Apache-2.0
#include "view/filters/sub_samples.h"

#include <span>

namespace raybundle {
namespace {

/// Rows of the places in columns of a 16x16 grid, each row once, chosen by a search for the
/// smallest error of the area beside a straight line: 0.030 rms, 0.10 at most.
constexpr std::array<unsigned, EDGE_SAMPLES> rows_of_16 = {5, 13, 1,  10, 6, 15, 3, 11,
                                                           8, 0,  12, 4,  7, 14, 2, 9};
constexpr std::array<unsigned, 4> rows_of_4 = {1, 3, 0, 2};
static_assert(rows_of_16.size() == STAGGER_PERIOD * STAGGER_PERIOD);

/// The place of part k of count.
float place_in(unsigned k, unsigned count) {
    return (static_cast<float>(k) + 0.5F) / static_cast<float>(count) - 0.5F;
}

}  // namespace

glm::vec2 sub_sample(unsigned k) {
    return {place_in(k, EDGE_SAMPLES), place_in(rows_of_16[k], EDGE_SAMPLES)};
}

PixelPlaces staggered_places(unsigned grid) {
    PixelPlaces places{};
    if (grid <= 1) {
        return places;
    }
    const unsigned block = grid == 2 ? 2 : STAGGER_PERIOD;
    const std::span<const unsigned> rows =
        grid == 2 ? std::span<const unsigned>(rows_of_4) : std::span<const unsigned>(rows_of_16);
    for (unsigned column = 0; column < rows.size(); ++column) {
        const glm::uvec2 pixel(column / block, rows[column] / block);
        const glm::vec2 place(place_in(column % block, block),
                              place_in(rows[column] % block, block));
        for (unsigned y = pixel.y; y < STAGGER_PERIOD; y += block) {
            for (unsigned x = pixel.x; x < STAGGER_PERIOD; x += block) {
                places[STAGGER_PERIOD * y + x] = place;
            }
        }
    }
    return places;
}

void set_places(layout::ViewParameters& view, const PixelPlaces& places) {
    for (unsigned k = 0; k < places.size(); k += 2) {
        view.places[k / 2] = glm::vec4(places[k], places[k + 1]);
    }
}

glm::vec2 place_in_pixel(const layout::ViewParameters& view, glm::uvec2 pixel) {
    const unsigned k = STAGGER_PERIOD * (pixel.y % STAGGER_PERIOD) + pixel.x % STAGGER_PERIOD;
    const glm::vec4& two = view.places[k / 2];
    return k % 2 == 0 ? glm::vec2(two.x, two.y) : glm::vec2(two.z, two.w);
}

}  // namespace raybundle
