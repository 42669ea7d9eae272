// SPDX-License-Identifier: Apache-2.0
// What a viewer is told about the error of the picture, when it is measured, and its target.
#include <algorithm>
#include <cmath>

#include "session/measure/stated_error.h"
#include "session/viewers/viewer_session.h"

namespace raybundle {

namespace {

constexpr std::uint64_t target_samples = 32;  // before an error is believed

}  // namespace

bool ViewerSession::target_met() {
    if (!image_) {
        return false;
    }
    if (target_.error > 0.0) {
        const ImageStatistics statistics = measured_statistics();
        return statistics.samples >= target_samples && statistics.meets(target_.error);
    }
    return target_.seconds > 0.0 && since_change_s(clock_.now()) >= target_.seconds;
}

ImageStatistics ViewerSession::measured_statistics() {
    return errors_.measured.with(image_->statistics());
}

bool ViewerSession::wants_check(TimePoint now) {
    // Paths would meet what the picture leaves out.
    return image_ && !camera_.cut() && acknowledged_ && !paused_ && !view_waits_ &&
           image_->smoothed() && since_change_s(now) >= pace_.check_after_s &&
           image_->statistics().known && image_->statistics().samples > 0 &&
           static_cast<double>(image_->samples()) >=
               next_check_factor * static_cast<double>(errors_.samples_at_check);
}

void ViewerSession::note_check(TimePoint now) {
    errors_.samples_at_check = image_->samples();
    errors_.last_check = now;
}

bool ViewerSession::wants_statistics(TimePoint now) const {
    return image_ && !paused_ &&
           seconds(now - errors_.last_statistics) >= pace_.statistics_interval_s;
}

void ViewerSession::refresh_statistics(TimePoint now) {
    errors_.last_statistics = now;
    image_->request_statistics();
}

void ViewerSession::fill_solution(v1::Solution* solution) {
    if (!image_ || !image_->statistics().known) {
        return;
    }
    const ImageStatistics statistics = measured_statistics();
    state_error(statistics, errors_.measured.known(), *solution);
    const auto rate = static_cast<double>(solution->iterations_per_second());
    if (target_.error > 0.0) {
        const double more = errors_.measured.samples_factor_to(target_.error, image_->statistics(),
                                                               image_->sample_order()) -
                            1.0;
        const double samples = more * static_cast<double>(image_->samples());
        if (target_met()) {
            if (statistics.error_high <= target_.error) {
                solution->set_seconds_to_target(0.0F);
            } else {
                solution->set_target_out_of_reach(true);
            }
        } else if (std::isfinite(more) && rate > 0.0) {
            solution->set_seconds_to_target(static_cast<float>(samples / rate));
        }
    } else if (target_.seconds > 0.0) {
        solution->set_seconds_to_target(
            static_cast<float>(std::max(0.0, target_.seconds - since_change_s(clock_.now()))));
    }
}

}  // namespace raybundle
