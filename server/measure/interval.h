// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace raybundle {

/// A number with an interval that holds the true one.
struct Interval {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// The t with P(T <= t) = probability, of Student's distribution (1908); probability in [0.5, 1).
double student_quantile(double probability, std::size_t degrees_of_freedom);

}  // namespace raybundle
