// SPDX-License-Identifier: Apache-2.0
#include "transport/iteration_schedule.h"

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

// Dimensions of the Halton sequences; perspective and layered iterations count separately.
constexpr unsigned rows = 5;  // of both kinds
enum Dimension : unsigned {
    choose_patch = 0,
    point_u = 1,
    point_v = 2,
    turn = 3,
    point_x = 4,
    point_y = 6
};
enum LayeredDimension : unsigned {
    polar = 0,
    azimuth = 1,
    window_turn = 2,
    shift_x = 3,
    shift_y = 4
};

}  // namespace

glm::vec3 uniform_direction(double u, double v) {
    const double z = 1.0 - 2.0 * u;
    const double r = std::sqrt(std::fmax(0.0, 1.0 - z * z));
    const double phi = 2.0 * glm::pi<double>() * v;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

IterationSchedule::IterationSchedule(std::uint64_t seed, const StrategyProbabilities& probabilities,
                                     bool shuffled)
    : probabilities_(probabilities), seed_(seed), shuffled_(shuffled), numbers_(seed) {}

/// Index of the next perspective sample in its sequence.
std::uint64_t IterationSchedule::next_perspective() {
    const std::uint64_t k = perspective_++;
    if (!shuffled_) {
        return k + 1;
    }
    const std::uint64_t at = k % shuffle_length;
    if (at == 0) {
        std::iota(order_.begin(), order_.end(), std::uint8_t{0});
        for (unsigned i = shuffle_length; i-- > 1;) {
            const std::uint64_t random = mix_bits(mix_bits(seed_ + k) + i);
            std::swap(order_[i], order_[random % (i + 1)]);
        }
    }
    return k - at + order_[at] + 1;
}

/// Every BATCHES iterations in a row fall to all batches, in an order drawn anew each time: with a
/// fixed one a batch would see but a part of the range of a sequence whose base divides its stride.
unsigned IterationSchedule::next_batch() {
    const auto k = static_cast<unsigned>(iterations_ % BATCHES);
    if (k == 0) {
        std::uint64_t random = mix_bits(seed_ ^ mix_bits(iterations_));
        for (unsigned i = BATCHES; i-- > 1; random /= i + 1) {
            std::swap(batch_order_[i], batch_order_[random % (i + 1)]);
        }
    }
    return batch_order_[k];
}

IterationSample IterationSchedule::next() {
    IterationSample sample;
    sample.batch = next_batch();
    const double which = numbers_.golden(iterations_++);
    constexpr double turn_range = 2.0 * 3.14159265358979323846;
    if (which < static_cast<double>(probabilities_.layered)) {
        const std::uint64_t k = ++layered_;
        sample.strategy = Strategy::layered;
        sample.row_phase = numbers_.sample(rows, k) < 0.5 ? 0 : 1;
        sample.direction =
            uniform_direction(numbers_.sample(polar, k), numbers_.sample(azimuth, k));
        sample.angle = turn_range * numbers_.sample(window_turn, k);
        sample.shift = {static_cast<float>(numbers_.sample(shift_x, k)),
                        static_cast<float>(numbers_.sample(shift_y, k))};
        return sample;
    }
    const std::uint64_t k = next_perspective();
    // A dimension of its own: the parity of k would go hand in hand with the choice of the patch.
    sample.row_phase = numbers_.sample(rows, k) < 0.5 ? 0 : 1;
    const auto [leading, trailing] = split(numbers_.sample(choose_patch, k));
    sample.shooter_numbers = {leading, trailing, static_cast<float>(numbers_.sample(point_u, k)),
                              static_cast<float>(numbers_.sample(point_v, k))};
    sample.angle = turn_range * numbers_.sample(turn, k);
    sample.shift = {static_cast<float>(numbers_.sample(point_x, k)),
                    static_cast<float>(numbers_.sample(point_y, k))};
    return sample;
}

}  // namespace raybundle
