// SPDX-License-Identifier: Apache-2.0
#include "view/error/sample_batches.h"

#include <algorithm>
#include <cmath>

namespace raybundle {
namespace {

constexpr double deviations_of_95 = 1.96;  // standard deviations, 95 %
constexpr double memory = 64.0;            // batches: views change
constexpr double usual_counts = 3.0;       // batches as which usual_luck() counts

}  // namespace

void SampleBatches::restart() {
    begin_ = squares_ = 0.0F;
    last_ = {};
    gained_ = 0.0;
    count_ = 0;
    empty_ = true;
    correlation_ = 1.0;
}

bool SampleBatches::end(const SampleWeights& all, SampleOrder order) {
    begin_ = last_.sum;
    const float weight = all.sum - last_.sum;
    empty_ = !(weight > 0.0F);
    if (empty_) {
        return false;
    }
    squares_ += weight * weight;
    gained_ += static_cast<double>(all.squares - last_.squares) *
               variance_of_mean(all.samples - last_.samples, order);
    last_ = all;
    ++count_;
    return true;
}

void SampleBatches::take(const Sums& sums) {
    if (empty_) {
        return;
    }
    if (sums.square > 0.0 && sums.other > 0.0) {
        const double cosine = sums.product / std::sqrt(sums.square * sums.other);
        const double kept = std::min(1.0, (memory - 1.0) / std::max(cosines_, 1.0));
        cosines_ = kept * cosines_ + 1.0;
        sum_ = kept * sum_ + cosine;
        squared_ = kept * squared_ + cosine * cosine;
    }
    if (count_ > 1 && sums.of_samples > 0.0 && gained_ > 0.0) {
        const double expected = sums.of_samples * gained_ / static_cast<double>(last_.squares);
        correlation_ = std::max(sums.variance / expected, 1.0);
    }
}

double SampleBatches::luck(SampleOrder order) const {
    const double usual_deviation = usual_luck(order) / deviations_of_95;
    const double usual = 2.0 * usual_deviation * usual_deviation;  // 1/m
    const double about_mean = cosines_ > 0.0 ? squared_ - sum_ * sum_ / cosines_ : 0.0;
    const double inverse_modes =
        (usual_counts * usual + about_mean) / (usual_counts + std::max(cosines_ - 1.0, 0.0));
    return deviations_of_95 * std::sqrt(0.5 * inverse_modes);
}

}  // namespace raybundle
