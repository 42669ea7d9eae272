// SPDX-License-Identifier: Apache-2.0
#include "reference/measures/batch_scatter.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace raybundle {
namespace {

/// 97.5 % quantile of Student's t, for more than a few degrees of freedom.
double t_quantile(double freedom) {
    return 1.96 + 2.37 / freedom + 2.8 / (freedom * freedom);
}

}  // namespace

BatchScatter::BatchScatter(std::size_t batches)
    : batches_(batches), gram_(batches * (batches + 1) / 2, 0.0) {}

void BatchScatter::add(std::span<const glm::dvec3> deviations, const glm::dvec3& mean) {
    auto element = gram_.begin();
    for (std::size_t row = 0; row < batches_; ++row) {
        for (std::size_t column = 0; column <= row; ++column) {
            *element++ += glm::dot(deviations[row], deviations[column]);
        }
    }
    squares_ += glm::dot(mean, mean);
    ++pixels_;
}

void BatchScatter::add(const BatchScatter& other) {
    std::transform(gram_.begin(), gram_.end(), other.gram_.begin(), gram_.begin(), std::plus<>());
    squares_ += other.squares_;
    pixels_ += other.pixels_;
}

ImageError BatchScatter::error() const {
    double trace = 0.0;
    double norm = 0.0;
    auto element = gram_.begin();
    for (std::size_t row = 0; row < batches_; ++row) {
        for (std::size_t column = 0; column < row; ++column) {
            norm += 2.0 * *element * *element;
            ++element;
        }
        trace += *element;
        norm += *element * *element;
        ++element;
    }
    const auto k = static_cast<double>(batches_ - 1);
    const double variance = trace / k;  // tr C
    if (!(variance > 0.0) || !(squares_ > 0.0)) {
        return {0.0, 0.0, 0.0};
    }
    // The noise of the means is no light; half of them where next to nothing else is left.
    const double light = std::max(squares_ - variance, 0.5 * squares_);
    const double relative = std::sqrt(variance / light);
    // At least as if all pixels and channels were independent and alike.
    const double of_squares = std::max((norm - trace * trace / k) / ((k + 2.0) * (k - 1.0)),
                                       variance * variance / (3.0 * static_cast<double>(pixels_)));
    // Of the squared error beside its estimate, which has 1/k of its variance.
    const double deviation = std::sqrt(2.0 * of_squares * (1.0 + 1.0 / k)) / variance;
    const double half_width = 0.5 * t_quantile(0.5 * (k + 2.0) * (k - 1.0)) * deviation;
    return {relative, relative * std::exp(-half_width), relative * std::exp(half_width)};
}

}  // namespace raybundle
