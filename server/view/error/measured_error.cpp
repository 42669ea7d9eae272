// SPDX-License-Identifier: Apache-2.0
#include "view/error/measured_error.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

void MeasuredError::take(const SquaredError& square, const ImageStatistics& by_samples) {
    constexpr double too_badly = 0.5;  // share of the squared error
    const double said = by_samples.relative_error;
    const double stated = said * said + carried_square_;
    if (by_samples.known && by_samples.samples > 0 && said > 0.0 && square.standard_error > 0.0 &&
        square.standard_error < too_badly * std::max(stated, square.value)) {
        square_ = square;
        said_ = by_samples;
        carried_square_ = 0.0;
    }
}

void MeasuredError::carry_over() {
    if (square_) {
        const double said = said_.relative_error;
        carried_square_ = std::max(square_->value - said * said, 0.0);
    }
    square_.reset();
}

/// The error may be all that samples say and all that was found beyond, or the former alone.
ImageStatistics MeasuredError::with_carried(const ImageStatistics& by_samples) const {
    ImageStatistics s = by_samples;
    if (s.known && carried_square_ > 0.0) {
        const double carried = std::sqrt(carried_square_);
        s.relative_error = std::hypot(s.relative_error, carried);
        s.error_high = std::hypot(s.error_high, carried);
    }
    return s;
}

/// The squared error as it is to be expected after more samples. Those have noise of their own,
/// whose few modes (view/error/error_interval.cpp) make it come out larger or smaller: a seventh
/// more samples change it by 18 % (independent) to 30 % (low-discrepancy; standard deviation).
SquaredError MeasuredError::now(const ImageStatistics& by_samples) const {
    constexpr double unforeseen = 0.7;  // of the squared error, for twice as many samples
    const double fallen = by_samples.relative_error / said_.relative_error;
    const double factor = fallen * fallen;
    const double more = static_cast<double>(by_samples.samples) /
                            static_cast<double>(std::max<std::uint64_t>(said_.samples, 1)) -
                        1.0;
    // What samples do not know of does not fall with their number.
    const double foreseen = std::min(square_->value, said_.relative_error * said_.relative_error);
    const double value = factor * foreseen + square_->value - foreseen;
    const double drift = unforeseen * std::max(value, 0.0) * std::sqrt(std::max(more, 0.0));
    return {value, std::hypot(factor * square_->standard_error, drift)};
}

ImageStatistics MeasuredError::with(const ImageStatistics& by_samples) const {
    if (!square_ || !by_samples.known || by_samples.samples == 0) {
        return with_carried(by_samples);
    }
    ImageStatistics s = by_samples;
    const SquaredError square = now(by_samples);
    const ErrorInterval interval = measured_interval({s.relative_error, s.error_low, s.error_high},
                                                     square.value, square.standard_error);
    s.relative_error = interval.error;
    s.error_low = interval.low;
    s.error_high = interval.high;
    const double rest =
        std::sqrt(std::max(interval.error * interval.error - s.noise * s.noise, 0.0));
    if (interval.low > by_samples.error_high || s.noise <= 0.5 * rest) {
        s.discretisation = std::max(s.discretisation, rest);
    }
    return s;
}

double MeasuredError::samples_factor_to(double target, const ImageStatistics& by_samples,
                                        SampleOrder order, double unresolved) const {
    const double resolved = by_samples.discretisation * std::sqrt(1.0 - unresolved * unresolved);
    if (!square_ || !(by_samples.relative_error > 0.0)) {
        return samples_factor(
            by_samples.noise,
            std::hypot(unresolved * by_samples.discretisation, std::sqrt(carried_square_)), target,
            by_samples.samples, order);
    }
    const ImageStatistics s = with(by_samples);
    const double then =
        std::sqrt(std::max(s.discretisation * s.discretisation - resolved * resolved, 0.0));
    return samples_factor(
        MeasuredPicture{
            {s.relative_error, s.error_low, s.error_high}, s.noise, s.discretisation, then},
        target, order);
}

}  // namespace raybundle
