// SPDX-License-Identifier: Apache-2.0
// What a viewer is told about the error of the picture, when it is measured, and its target.
#include <algorithm>
#include <cmath>

#include "scheduling/elapsed.h"
#include "session/viewers/stated_error.h"
#include "session/viewers/viewer_session.h"

namespace raybundle {

namespace {

constexpr double statistics_interval_s = 0.15;
constexpr double check_after_s = 1.0;         // of rest
constexpr std::uint64_t target_samples = 32;  // before an error is believed

}  // namespace

bool ViewerSession::target_met() {
    if (!image_) {
        return false;
    }
    if (target_error_ > 0.0) {
        const ImageStatistics statistics = measured_statistics();
        return statistics.samples >= target_samples && statistics.meets(target_error_);
    }
    return target_seconds_ > 0.0 && since_change_s(Clock::now()) >= target_seconds_;
}

ImageStatistics ViewerSession::measured_statistics() {
    return measured_.with(image_->statistics());
}

bool ViewerSession::wants_check(Clock::time_point now) {
    // Paths would meet what the picture leaves out.
    return image_ && !camera_.cut() && acknowledged_ && !paused_ && !view_waits_ &&
           image_->smoothed() && since_change_s(now) >= check_after_s &&
           image_->statistics().known && image_->statistics().samples > 0 &&
           static_cast<double>(image_->samples()) >=
               next_check_factor * static_cast<double>(samples_at_check_);
}

void ViewerSession::note_check(Clock::time_point now) {
    samples_at_check_ = image_->samples();
    last_check_ = now;
}

bool ViewerSession::wants_statistics(Clock::time_point now) const {
    return image_ && !paused_ && seconds(now - last_statistics_) >= statistics_interval_s;
}

void ViewerSession::refresh_statistics(Clock::time_point now) {
    last_statistics_ = now;
    image_->request_statistics();
}

void ViewerSession::fill_solution(v1::Solution* solution) {
    if (!image_ || !image_->statistics().known) {
        return;
    }
    const ImageStatistics statistics = measured_statistics();
    state_error(statistics, measured_.known(), *solution);
    const auto rate = static_cast<double>(solution->iterations_per_second());
    if (target_error_ > 0.0) {
        const double more = measured_.samples_factor_to(target_error_, image_->statistics(),
                                                        image_->sample_order()) -
                            1.0;
        const double samples = more * static_cast<double>(image_->samples());
        if (target_met()) {
            if (statistics.error_high <= target_error_) {
                solution->set_seconds_to_target(0.0F);
            }
        } else if (std::isfinite(more) && rate > 0.0) {
            solution->set_seconds_to_target(static_cast<float>(samples / rate));
        }
    } else if (target_seconds_ > 0.0) {
        solution->set_seconds_to_target(
            static_cast<float>(std::max(0.0, target_seconds_ - since_change_s(Clock::now()))));
    }
}

}  // namespace raybundle
