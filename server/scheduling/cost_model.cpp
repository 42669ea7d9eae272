// SPDX-License-Identifier: Apache-2.0
#include "scheduling/cost_model.h"

#include <algorithm>
#include <cmath>

namespace raybundle {
namespace {

constexpr double mega = 1e6;
constexpr double iteration_memory = 0.995;  ///< weight that an iteration keeps at the next
constexpr double frame_memory = 0.97;       ///< weight that a frame keeps at the next
constexpr double prior_weight = 1e-2;       ///< of an assumed slope, in megapixels²

bool usable(double milliseconds, double pixels) {
    return std::isfinite(milliseconds) && milliseconds >= 0.0 && pixels >= 0.0;
}

}  // namespace

void CostModel::note_iteration(double milliseconds, double pixels) {
    if (!usable(milliseconds, pixels)) {
        return;
    }
    const double x = pixels / mega;
    w_ = iteration_memory * w_ + 1.0;
    x_ = iteration_memory * x_ + x;
    y_ = iteration_memory * y_ + milliseconds;
    xx_ = iteration_memory * xx_ + x * x;
    xy_ = iteration_memory * xy_ + x * milliseconds;
}

void CostModel::note_frame(double milliseconds, double pixels) {
    if (usable(milliseconds, pixels) && pixels > 0.0) {
        const double x = pixels / mega;
        frame_xx_ = frame_memory * frame_xx_ + x * x;
        frame_xy_ = frame_memory * frame_xy_ + x * milliseconds;
    }
}

/// Least squares through the origin, so that what every frame costs, however small, does not count
/// as the price of its few pixels.
double CostModel::frame_ms_per_pixel() const {
    const double prior = prior_frame_ms * mega;
    return (frame_xy_ + prior_weight * prior) / (frame_xx_ + prior_weight) / mega;
}

/// Least squares, with the assumed slope as a weak prior: it decides while all observations had
/// the same number of pixels. Neither part is negative.
CostModel::Line CostModel::iteration_line() const {
    if (w_ <= 0.0) {
        return {};
    }
    const double mean_x = x_ / w_;
    const double mean_y = y_ / w_;
    const double spread = std::max(xx_ / w_ - mean_x * mean_x, 0.0);
    const double covariance = xy_ / w_ - mean_x * mean_y;
    const double prior = prior_receive_ms * mega;
    const double most = mean_x > 0.0 ? std::max(mean_y / mean_x, 0.0) : prior;
    const double slope =
        std::clamp((covariance + prior_weight * prior) / (spread + prior_weight), 0.0, most);
    return {mean_y - slope * mean_x, slope / mega};
}

double CostModel::round_ms(double pixels) const {
    const Line line = iteration_line();
    return line.base + (line.slope + frame_ms_per_pixel()) * pixels;
}

CostModel::Verdict CostModel::admit(std::uint32_t width, std::uint32_t height, double present,
                                    double limit_ms) const {
    const double wanted = static_cast<double>(width) * static_cast<double>(height);
    if (present <= 0.0 || round_ms(present + wanted) <= limit_ms) {
        return {};
    }
    const double per_pixel = round_ms(1.0) - round_ms(0.0);
    const double room = (limit_ms - round_ms(present)) / std::max(per_pixel, 1e-12);
    if (room < min_pixels) {
        return {false, std::nullopt};
    }
    const double scale = std::sqrt(room / wanted);
    const auto scaled = [scale](std::uint32_t length) {
        return std::max(1U, static_cast<std::uint32_t>(std::floor(scale * length)));
    };
    return {false, std::pair(scaled(width), scaled(height))};
}

}  // namespace raybundle
