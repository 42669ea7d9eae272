// SPDX-License-Identifier: Apache-2.0
#include "research/primary_sample.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace raybundle {
namespace {

/// Standard deviation of a small mutation of one coordinate.
constexpr double small_step = 0.01;

/// A standard normal number (Box, Muller 1958).
double normal_number(RandomStream& random) {
    const glm::dvec2 u = random.next_pair();
    return std::sqrt(-2.0 * std::log(u.x)) * std::cos(glm::two_pi<double>() * u.y);
}

}  // namespace

void PrimarySample::propose(bool large) {
    ++time_;
    large_ = large;
    drawn_ = 0;
}

void PrimarySample::accept() {
    if (large_) {
        large_time_ = time_;
    }
}

void PrimarySample::reject() {
    for (Coordinate& coordinate : coordinates_) {
        if (coordinate.time == time_) {
            coordinate.value = coordinate.kept_value;
            coordinate.time = coordinate.kept_time;
        }
    }
    --time_;
}

void PrimarySample::mutate(Coordinate& coordinate) {
    // What a large step since then has made of it.
    if (coordinate.time < large_time_) {
        coordinate.value = random_.next();
        coordinate.time = large_time_;
    }
    coordinate.kept_value = coordinate.value;
    coordinate.kept_time = coordinate.time;
    if (large_) {
        coordinate.value = random_.next();
    } else {
        // All small steps since it was last asked for, at once.
        const auto steps = static_cast<double>(time_ - coordinate.time);
        const double moved =
            coordinate.value + small_step * std::sqrt(steps) * normal_number(random_);
        coordinate.value = moved - std::floor(moved);
    }
    coordinate.time = time_;
}

double PrimarySample::next() {
    if (drawn_ == coordinates_.size()) {
        coordinates_.emplace_back();
    }
    Coordinate& coordinate = coordinates_[drawn_++];
    mutate(coordinate);
    return coordinate.value;
}

glm::dvec2 PrimarySample::next_pair() {
    const double first = next();
    return {first, next()};
}

}  // namespace raybundle
