// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "journal/solution_exchange.h"

namespace raybundle {

/// An estimate as it is stored: a head, then of each patch the sum of samples times their weight
/// (lx; r, g, b) and the sum of weights, 16 bytes. Little-endian, single precision.
struct EstimateHead {
    SolutionState state;
    std::uint32_t number = 0;  ///< of the worker's estimates, from 1
};
constexpr std::size_t estimate_head_bytes = 24;

/// Bytes of an estimate of so many patches.
constexpr std::size_t estimate_bytes(std::uint32_t patches) {
    return estimate_head_bytes + std::size_t{patches} * sizeof(glm::vec4);
}

/// unit: lx of one unit of the means.
[[nodiscard]] std::string encode_estimate(const EstimateHead& head, const PatchMeans& means,
                                          float unit);
/// Of the first bytes of an estimate; nothing where they are none.
[[nodiscard]] std::optional<EstimateHead> read_estimate_head(std::string_view bytes);
/// Why an estimate with this head cannot be merged into a state; empty: its head allows it.
[[nodiscard]] std::string problem_of_head(const std::optional<EstimateHead>& head,
                                          const SolutionState& state);
/// The same of the whole of it.
[[nodiscard]] std::string problem_of_estimate(std::string_view bytes, const SolutionState& state);

/// Adds up estimates that have no problem, always in the same order: sums are exact to double
/// precision.
class EstimateSum {
  public:
    explicit EstimateSum(std::uint32_t patches) : sums_(patches, glm::dvec4(0.0)) {}

    void add(std::string_view estimate);
    /// unit: as for encode_estimate().
    [[nodiscard]] MergedMeans means(float unit) const;

  private:
    std::vector<glm::dvec4> sums_;
    MergedMeans result_;  // without means
};

}  // namespace raybundle
