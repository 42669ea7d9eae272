// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/mix_bits.h"

namespace raybundle {

/// Radical inverse of an index in a prime base (van der Corput): in [0, 1).
double radical_inverse(unsigned base, std::uint64_t index);

/// One dimension of a Halton sequence, randomised by a Cranley-Patterson rotation (1976) that
/// depends on the seed and the dimension.
class RandomisedHalton {
  public:
    explicit RandomisedHalton(std::uint64_t seed) : key_(mix_bits(seed)) {}

    /// Dimension 0..11, any index; in [0, 1).
    [[nodiscard]] double sample(unsigned dimension, std::uint64_t index) const;
    /// Additive golden-ratio sequence: the evenest choice between strategies.
    [[nodiscard]] double golden(std::uint64_t index) const;
    /// Dimension 0..2 of the additive recurrence in three dimensions (Roberts 2018, "The
    /// Unreasonable Effectiveness of Quasirandom Sequences"): evener than Halton's at small counts.
    /// golden() must not be paired with Halton dimensions: with base 3 it misses parts of the
    /// square for thousands of points.
    [[nodiscard]] double recurrence(unsigned dimension, std::uint64_t index) const;

  private:
    [[nodiscard]] double shift(unsigned dimension) const;
    std::uint64_t key_;
};

}  // namespace raybundle
