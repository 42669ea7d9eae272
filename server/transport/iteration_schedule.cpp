// SPDX-License-Identifier: Apache-2.0
#include "transport/iteration_schedule.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
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

constexpr unsigned rows = 5;  // of both kinds
// Dimensions of the Halton sequences; perspective and layered iterations count separately.
enum Dimension : unsigned { choose_patch = 0, point_u = 1, point_v = 2, turn = 3 };
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

IterationSchedule::IterationSchedule(std::uint64_t seed, const StrategyProbabilities& probabilities)
    : probabilities_(probabilities), batches_([seed]<std::size_t... I>(std::index_sequence<I...>) {
          return std::array<Batch, BATCHES>{
              Batch{RandomisedHalton(seed, static_cast<unsigned>(I))}...};
      }(std::make_index_sequence<BATCHES>())) {}

IterationSample IterationSchedule::next() {
    IterationSample sample;
    sample.batch = static_cast<unsigned>(iterations_ % BATCHES);
    ++iterations_;
    Batch& batch = batches_[sample.batch];
    const double which = batch.numbers.golden(batch.iterations++);
    constexpr double turn_range = 2.0 * 3.14159265358979323846;
    if (which < static_cast<double>(probabilities_.layered)) {
        const std::uint64_t k = ++batch.layered;
        sample.strategy = Strategy::layered;
        sample.row_phase = batch.numbers.sample(rows, k) < 0.5 ? 0 : 1;
        sample.direction =
            uniform_direction(batch.numbers.sample(polar, k), batch.numbers.sample(azimuth, k));
        sample.angle = turn_range * batch.numbers.sample(window_turn, k);
        sample.shift = {static_cast<float>(batch.numbers.sample(shift_x, k)),
                        static_cast<float>(batch.numbers.sample(shift_y, k))};
        return sample;
    }
    const std::uint64_t k = ++batch.perspective;
    // A dimension of its own: the parity of k would go hand in hand with the choice of the patch.
    sample.row_phase = batch.numbers.sample(rows, k) < 0.5 ? 0 : 1;
    const auto [leading, trailing] = split(batch.numbers.sample(choose_patch, k));
    sample.shooter_numbers = {leading, trailing,
                              static_cast<float>(batch.numbers.sample(point_u, k)),
                              static_cast<float>(batch.numbers.sample(point_v, k))};
    sample.angle = turn_range * batch.numbers.sample(turn, k);
    return sample;
}

}  // namespace raybundle
