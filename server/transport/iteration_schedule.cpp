// SPDX-License-Identifier: Apache-2.0
#include "transport/iteration_schedule.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>
#include <utility>

namespace raybundle {

namespace {

/// Splits a number into its leading 24 bits and the next 24 (both exact in a float).
std::pair<float, float> split(double u) {
    constexpr double bits = 16777216.0;
    const double leading = std::floor(u * bits);
    return {static_cast<float>(leading / bits),
            static_cast<float>(std::floor((u * bits - leading) * bits) / bits)};
}

// Dimensions of the Halton sequences; every strategy counts its own iterations.
constexpr unsigned rows = 5;  // of all kinds
enum Dimension : unsigned {
    choose_patch = 0,
    point_u = 1,
    point_v = 2,
    turn = 3,
    point_x = 4,
    point_y = 6,
    faces = 7
};
enum ParallelDimension : unsigned {
    polar = 0,
    azimuth = 1,
    window_turn = 2,
    shift_x = 3,
    shift_y = 4
};
enum OpeningDimension : unsigned {
    choose_opening = 0,
    opening_u = 1,
    opening_v = 2,
    opening_w = 3,
    opening_turn = 4,
    opening_shift_x = 6,
    opening_shift_y = 7
};
constexpr double turn_range = 2.0 * glm::pi<double>();
constexpr std::uint64_t strategy_key = 0x5851f42dU;
constexpr std::uint64_t layered_key = 0x2545f491U;
constexpr std::uint64_t plane_key = 0x9d2c5680U;  // tells the sequence of plane bundles apart
constexpr std::uint64_t opening_key = 0x61c88647U;

}  // namespace

glm::vec3 uniform_direction(double u, double v) {
    const double z = 1.0 - 2.0 * u;
    const double r = std::sqrt(std::fmax(0.0, 1.0 - z * z));
    const double phi = 2.0 * glm::pi<double>() * v;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

IterationSchedule::IterationSchedule(std::uint64_t seed, const StrategyProbabilities& probabilities,
                                     bool shuffled, unsigned planes_per_direction)
    : probabilities_(probabilities),
      planes_per_direction_(std::max(planes_per_direction, 1U)),
      numbers_(seed),
      plane_numbers_(mix_bits(seed ^ plane_key)),
      opening_numbers_(mix_bits(seed ^ opening_key)),
      strategies_(mix_bits(seed ^ strategy_key), shuffled ? direction_block : 1),
      layered_(mix_bits(seed ^ layered_key), shuffled ? direction_block : 1),
      planes_(mix_bits(seed ^ plane_key), shuffled ? direction_block : 1),
      perspective_(seed, shuffled ? shooter_block : 1),
      openings_(mix_bits(seed ^ opening_key), shuffled ? shooter_block : 1) {}

std::uint64_t IterationSchedule::Indices::next() {
    const auto length = static_cast<unsigned>(order_.size());
    const std::uint64_t k = count_++;
    const std::uint64_t at = k % length;
    if (at == 0) {
        std::iota(order_.begin(), order_.end(), std::uint16_t{0});
        for (unsigned i = length; i-- > 1;) {
            const std::uint64_t random = mix_bits(mix_bits(key_ + k) + i);
            std::swap(order_[i], order_[random % (i + 1)]);
        }
    }
    return k - at + order_[at] + 1;
}

IterationSample IterationSchedule::next() {
    IterationSample sample;
    const double which = numbers_.golden(strategies_.next() - 1);
    const auto layered = static_cast<double>(probabilities_.layered);
    const double parallel = layered + static_cast<double>(probabilities_.plane);
    if (which < layered) {
        sample.strategy = Strategy::layered;
        sample_window(sample, numbers_, layered_.next());
    } else if (which < parallel) {
        sample_plane(sample, planes_.next() - 1);
    } else if (which < parallel + static_cast<double>(probabilities_.opening)) {
        sample_opening(sample, openings_.next());
    } else {
        sample_shooter(sample, perspective_.next());
    }
    return sample;
}

void IterationSchedule::sample_window(IterationSample& sample, const RandomisedHalton& numbers,
                                      std::uint64_t k) {
    sample.row_phase = numbers.sample(rows, k);
    // Light goes both ways: half of the sphere says it all, and more evenly.
    sample.direction =
        uniform_direction(0.5 * numbers.sample(polar, k), numbers.sample(azimuth, k));
    sample.angle = turn_range * numbers.sample(window_turn, k);
    sample.shift = {static_cast<float>(numbers.sample(shift_x, k)),
                    static_cast<float>(numbers.sample(shift_y, k))};
}

void IterationSchedule::sample_plane(IterationSample& sample, std::uint64_t k) const {
    const std::uint64_t k_direction = k / planes_per_direction_;
    const auto in_row = static_cast<double>(k % planes_per_direction_) / planes_per_direction_;
    sample.strategy = Strategy::plane;
    sample_window(sample, plane_numbers_, k_direction + 1);
    sample.direction = uniform_direction(plane_numbers_.recurrence(0, k_direction),
                                         plane_numbers_.recurrence(1, k_direction));
    const double plane = plane_numbers_.recurrence(2, k_direction) + in_row;
    sample.plane = plane - std::floor(plane);
}

void IterationSchedule::sample_shooter(IterationSample& sample, std::uint64_t k) const {
    sample.strategy = Strategy::perspective;
    // A dimension of its own: the parity of k would go hand in hand with the choice of the patch.
    sample.row_phase = numbers_.sample(rows, k);
    const auto [leading, trailing] = split(numbers_.sample(choose_patch, k));
    sample.shooter_numbers = {leading, trailing, static_cast<float>(numbers_.sample(point_u, k)),
                              static_cast<float>(numbers_.sample(point_v, k))};
    sample.angle = turn_range * numbers_.sample(turn, k);
    sample.shift = {static_cast<float>(numbers_.sample(point_x, k)),
                    static_cast<float>(numbers_.sample(point_y, k))};
    sample.faces = static_cast<float>(numbers_.sample(faces, k));
}

void IterationSchedule::sample_opening(IterationSample& sample, std::uint64_t k) const {
    const RandomisedHalton& numbers = opening_numbers_;
    const auto number = [&](unsigned dimension) {
        return static_cast<float>(numbers.sample(dimension, k));
    };
    sample.strategy = Strategy::opening;
    sample.row_phase = numbers.sample(rows, k);
    sample.opening_numbers = {number(choose_opening), number(opening_u), number(opening_v),
                              number(opening_w)};
    sample.angle = turn_range * numbers.sample(opening_turn, k);
    sample.shift = {number(opening_shift_x), number(opening_shift_y)};
}

}  // namespace raybundle
