// SPDX-License-Identifier: Apache-2.0
#include "net/network_state.h"

#include <string_view>
#include <utility>

namespace raybundle {
namespace {

std::string metric(std::string_view name, std::string_view type, std::string_view help,
                   std::uint64_t value) {
    std::string text;
    text.append("# HELP ").append(name).append(" ").append(help).append("\n");
    text.append("# TYPE ").append(name).append(" ").append(type).append("\n");
    text.append(name).append(" ").append(std::to_string(value)).append("\n");
    return text;
}

}  // namespace

void NetworkState::set_metrics_source(std::function<std::string()> source) {
    const std::lock_guard lock(metrics_mutex_);
    metrics_source_ = std::move(source);
}

std::string NetworkState::metrics() const {
    std::string text =
        metric("raybundle_viewers", "gauge", "Connected viewers.", viewers.size()) +
        metric("raybundle_frames_queued_total", "counter", "Frames handed over for sending.",
               counters.frames_queued) +
        metric("raybundle_frames_replaced_total", "counter", "Frames dropped for a newer one.",
               counters.frames_replaced) +
        metric("raybundle_sent_bytes_total", "counter", "WebSocket payload sent.",
               counters.bytes_sent) +
        metric("raybundle_connections_refused_total", "counter",
               "Connections refused by origin, path or number.", counters.connections_refused);
    const std::lock_guard lock(metrics_mutex_);
    if (metrics_source_) {
        text += metrics_source_();
    }
    return text;
}

}  // namespace raybundle
