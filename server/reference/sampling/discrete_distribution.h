// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace raybundle {

/// Random choice of an index with probability proportional to its weight.
class DiscreteDistribution {
  public:
    DiscreteDistribution() = default;
    /// weights: not negative. Where all are 0 the distribution is empty.
    explicit DiscreteDistribution(const std::vector<double>& weights)
        : cumulative_(weights.size()) {
        std::partial_sum(weights.begin(), weights.end(), cumulative_.begin());
        if (empty()) {
            cumulative_.clear();
            return;
        }
        const double total = cumulative_.back();
        for (double& c : cumulative_) {
            c /= total;
        }
        // What rounding left above the last positive weight must not be chosen.
        const auto first_full = std::find(cumulative_.begin(), cumulative_.end(), 1.0);
        std::fill(first_full, cumulative_.end(), 1.0);
    }

    [[nodiscard]] bool empty() const { return cumulative_.empty() || !(cumulative_.back() > 0.0); }
    /// u in [0, 1).
    [[nodiscard]] std::size_t sample(double u) const {
        const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), u);
        return std::min(static_cast<std::size_t>(found - cumulative_.begin()),
                        cumulative_.size() - 1);
    }
    [[nodiscard]] double probability(std::size_t index) const {
        return index == 0 ? cumulative_[0] : cumulative_[index] - cumulative_[index - 1];
    }

  private:
    std::vector<double> cumulative_;
};

}  // namespace raybundle
