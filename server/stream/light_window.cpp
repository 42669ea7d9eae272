// SPDX-License-Identifier: Apache-2.0
#include "stream/light_window.h"

#include <algorithm>

namespace raybundle {

void LightWindow::on_sent(std::uint32_t number, std::size_t bytes, double now_ms) {
    sent_.push_back({number, bytes, now_ms});
}

void LightWindow::on_ack(std::uint32_t number, double now_ms) {
    if (sent_.empty() || number > sent_.back().number || number < sent_.front().number) {
        return;
    }
    std::size_t arrived = 0;
    double sent_ms = now_ms;
    while (!sent_.empty() && sent_.front().number <= number) {
        arrived += sent_.front().bytes;
        sent_ms = sent_.front().at_ms;
        sent_.pop_front();
    }
    const double round_trip_ms = now_ms - sent_ms;
    round_trips_ms_.push_back(round_trip_ms);
    if (round_trips_ms_.size() > kRoundTripsKept) {
        round_trips_ms_.pop_front();
    }
    const double base_ms = *std::min_element(round_trips_ms_.begin(), round_trips_ms_.end());
    window_ = round_trip_ms - base_ms > kTargetMs ? std::max(window_ / 2, kMin)
                                                  : std::min(window_ + arrived, kMax);
}

}  // namespace raybundle
