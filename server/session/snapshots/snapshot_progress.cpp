// SPDX-License-Identifier: Apache-2.0
// What those who wait for snapshots hear.
#include <cmath>

#include "session/snapshots/snapshot_queue.h"
#include "view/error/error_interval.h"

namespace raybundle {

/// What is known of the picture that is being made.
v1::SnapshotProgress SnapshotQueue::progress_of_first() const {
    v1::SnapshotProgress progress;
    if (!picture_.image || picture_.image->samples() < min_samples ||
        !picture_.image->statistics().known) {
        return progress;
    }
    const ImageStatistics& statistics = picture_.image->statistics();
    progress.set_relative_error(static_cast<float>(statistics.error_high));
    const double factor =
        samples_factor(statistics.noise, statistics.discretisation, requests_.front().error(),
                       statistics.samples, picture_.image->sample_order());
    if (std::isfinite(factor)) {
        const double spent = seconds(clock_.now() - picture_.begun);
        const auto after =
            static_cast<double>(picture_.tiles->count() - picture_.tiles->done() - 1);
        progress.set_seconds_left(static_cast<float>((factor - 1.0 + factor * after) * spent));
    }
    return progress;
}

void SnapshotQueue::report() {
    const auto now = clock_.now();
    if (requests_.empty() || seconds(now - last_report_) < pace_.report_interval_s) {
        return;
    }
    last_report_ = now;
    for (std::size_t i = 0; i < requests_.size(); ++i) {
        const ClientEvent& event = requests_[i].event;
        if (!event.message.has_id() ||
            seconds(now - requests_[i].since) < pace_.report_interval_s) {
            continue;
        }
        v1::ServerMessage message;
        v1::SnapshotProgress& progress = *message.mutable_snapshot_progress();
        if (i == 0) {
            progress = progress_of_first();
        }
        progress.set_request(event.message.id());
        progress.set_ahead(static_cast<std::uint32_t>(i));
        server_.send(event.viewer, message);
    }
}

}  // namespace raybundle
