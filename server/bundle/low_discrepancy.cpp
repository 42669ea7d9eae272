// SPDX-License-Identifier: Apache-2.0
#include "bundle/low_discrepancy.h"

#include <array>
#include <cmath>

namespace raybundle {

namespace {
constexpr std::array<unsigned, 12> primes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
constexpr unsigned golden_dimension = 97;
constexpr unsigned recurrence_dimension = 101;

double wrap(double x) {
    return x - std::floor(x);
}
}  // namespace

double radical_inverse(unsigned base, std::uint64_t index) {
    const double inverse_base = 1.0 / base;
    double scale = inverse_base;
    double result = 0.0;
    for (; index > 0; index /= base, scale *= inverse_base) {
        result += static_cast<double>(index % base) * scale;
    }
    return result;
}

double RandomisedHalton::shift(unsigned dimension) const {
    return static_cast<double>(mix_bits(key_ * 131 + dimension) >> 11U) * 0x1.0p-53;
}

double RandomisedHalton::sample(unsigned dimension, std::uint64_t index) const {
    return wrap(radical_inverse(primes[dimension % primes.size()], index) + shift(dimension));
}

double RandomisedHalton::golden(std::uint64_t index) const {
    constexpr double golden_ratio_conjugate = 0.618033988749894848;
    return wrap(static_cast<double>(index) * golden_ratio_conjugate + shift(golden_dimension));
}

double RandomisedHalton::recurrence(unsigned dimension, std::uint64_t index) const {
    constexpr double root = 1.22074408460575947536;  // of x^4 = x + 1
    constexpr std::array<double, 3> steps = {1.0 / root, 1.0 / (root * root),
                                             1.0 / (root * root * root)};
    dimension %= steps.size();
    return wrap(static_cast<double>(index) * steps[dimension] +
                shift(recurrence_dimension + dimension));
}

}  // namespace raybundle
