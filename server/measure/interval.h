// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace raybundle {

/// A number with an interval that holds the true one.
struct Interval {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// A number as batches estimate it, normally distributed.
struct BatchEstimate {
    double value = 0.0;
    double error = 0.0;  ///< standard error, from the scatter of the batches
};

/// The t with P(T <= t) = probability, of Student's distribution (1908); probability in [0.5, 1).
double student_quantile(double probability, std::size_t degrees_of_freedom);

/// Of the largest of the true numbers, which lies beyond each end with probability `beyond` at
/// most, however the estimates depend on each other. Above the largest of all upper bounds it lies
/// only where the bound of the largest number fails, so each has 1 - beyond. Below the largest
/// lower bound it lies where any of them fails, so each of n has 1 - beyond/n (Bonferroni). There
/// is one estimate at least.
Interval interval_of_largest(std::span<const BatchEstimate> estimates, double beyond,
                             std::size_t degrees_of_freedom);
/// Of the smallest, alike.
Interval interval_of_smallest(std::span<const BatchEstimate> estimates, double beyond,
                              std::size_t degrees_of_freedom);

}  // namespace raybundle
