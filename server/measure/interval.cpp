// SPDX-License-Identifier: Apache-2.0
#include "measure/interval.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace raybundle {
namespace {

/// P(-t < T < t); finite sums of Abramowitz, Stegun, 26.7.3 and 26.7.4.
double two_sided(double t, std::size_t degrees) {
    const double angle = std::atan(t / std::sqrt(static_cast<double>(degrees)));
    const double square = std::cos(angle) * std::cos(angle);
    const bool odd = degrees % 2 == 1;
    double term = odd ? std::cos(angle) : 1.0;
    double sum = odd && degrees == 1 ? 0.0 : term;
    for (std::size_t k = odd ? 3 : 2; k + 1 < degrees; k += 2) {
        term *= square * (static_cast<double>(k) - 1.0) / static_cast<double>(k);
        sum += term;
    }
    return odd ? 2.0 / std::numbers::pi * (angle + std::sin(angle) * sum) : std::sin(angle) * sum;
}

}  // namespace

double student_quantile(double probability, std::size_t degrees_of_freedom) {
    const double wanted = 2.0 * probability - 1.0;
    double low = 0.0;
    double high = 1.0;
    while (two_sided(high, degrees_of_freedom) < wanted && high < 1e6) {
        low = high;
        high *= 2.0;
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (two_sided(middle, degrees_of_freedom) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

Interval interval_of_largest(std::span<const BatchEstimate> estimates, double beyond,
                             std::size_t degrees_of_freedom) {
    const double one = student_quantile(1.0 - beyond, degrees_of_freedom);
    const double all =
        student_quantile(1.0 - beyond / static_cast<double>(estimates.size()), degrees_of_freedom);
    const BatchEstimate& first = estimates.front();
    Interval largest{first.value, first.value - all * first.error, first.value + one * first.error};
    for (const BatchEstimate& estimate : estimates) {
        largest.value = std::max(largest.value, estimate.value);
        largest.low = std::max(largest.low, estimate.value - all * estimate.error);
        largest.high = std::max(largest.high, estimate.value + one * estimate.error);
    }
    return largest;
}

Interval interval_of_smallest(std::span<const BatchEstimate> estimates, double beyond,
                              std::size_t degrees_of_freedom) {
    std::vector<BatchEstimate> negative(estimates.begin(), estimates.end());
    for (BatchEstimate& estimate : negative) {
        estimate.value = -estimate.value;
    }
    const Interval largest = interval_of_largest(negative, beyond, degrees_of_freedom);
    return {-largest.value, -largest.high, -largest.low};
}

}  // namespace raybundle
