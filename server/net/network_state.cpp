// SPDX-License-Identifier: Apache-2.0
#include "net/network_state.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "net/clock.h"
#include "net/http/metrics_text.h"

namespace raybundle {
namespace {

/// Queueing delays of all viewers' frames, seconds: median, 95th percentile and largest.
void add_queue_delays(const ViewerTable& viewers, MetricsText& out) {
    std::vector<double> delays;
    for (const auto& link : viewers.all()) {
        delays.push_back(link->queueing_delay_ms() / 1000.0);
    }
    std::sort(delays.begin(), delays.end());
    out.family("raybundle_queue_delay_seconds", "summary",
               "Delay of frames above the base round trip, over viewers");
    for (const auto& [label, share] :
         {std::pair("quantile=\"0.5\"", 0.5), std::pair("quantile=\"0.95\"", 0.95),
          std::pair("quantile=\"1\"", 1.0)}) {
        const auto last = static_cast<double>(delays.size()) - 1.0;
        const double value =
            delays.empty() ? 0.0 : delays[static_cast<std::size_t>(std::ceil(share * last))];
        out.sample("raybundle_queue_delay_seconds", label, value);
    }
}

}  // namespace

void NetworkState::set_metrics_source(std::function<std::string()> source) {
    const std::lock_guard lock(metrics_mutex_);
    metrics_source_ = std::move(source);
}

void NetworkState::set_editable_source(std::function<bool()> source) {
    const std::lock_guard lock(metrics_mutex_);
    editable_source_ = std::move(source);
}

bool NetworkState::editable() const {
    const std::lock_guard lock(metrics_mutex_);
    return !editable_source_ || editable_source_();
}

void NetworkState::set_photometry_source(std::function<std::string()> source) {
    const std::lock_guard lock(upload_mutex_);
    photometry_source_ = std::move(source);
}

std::optional<std::string> NetworkState::photometry() const {
    std::function<std::string()> source;  // reads files, which may take a while
    {
        const std::lock_guard lock(upload_mutex_);
        source = photometry_source_;
    }
    return source ? std::optional(source()) : std::nullopt;
}

void NetworkState::set_presence(std::string json) {
    const std::lock_guard lock(presence_mutex_);
    presence_ = std::move(json);
}

std::string NetworkState::presence() const {
    const std::lock_guard lock(presence_mutex_);
    return presence_;
}

void NetworkState::set_upload_factory(UploadFactory factory) {
    const std::lock_guard lock(upload_mutex_);
    upload_factory_ = std::move(factory);
}

void NetworkState::set_document_source(const void* owner, DocumentSource source) {
    const std::lock_guard lock(document_mutex_);
    if (source || document_owner_ == owner) {
        document_owner_ = source ? owner : nullptr;
        document_source_ = std::move(source);
    }
}

void NetworkState::make_document(DocumentRequest request,
                                 std::function<void(DocumentResult)> done) const {
    const std::lock_guard lock(document_mutex_);
    if (document_source_) {
        document_source_(std::move(request), std::move(done));
    } else {
        done({503, "text/plain; charset=utf-8", "No scene is served yet; try again later\n", {}});
    }
}

std::unique_ptr<Upload> NetworkState::begin_upload(const std::string& name) const {
    const std::lock_guard lock(upload_mutex_);
    return upload_factory_ ? upload_factory_(name) : nullptr;
}

std::string NetworkState::metrics() const {
    MetricsText out;
    const auto count = [](const std::atomic<std::uint64_t>& counter) {
        return static_cast<double>(counter.load());
    };
    out.family("raybundle_build_info", "gauge", "Version of the server");
    out.sample("raybundle_build_info", "version=\"" RAYBUNDLE_VERSION "\"", 1.0);
    out.gauge("raybundle_uptime_seconds", "Since the program started", server_time_ms() / 1000.0);
    out.gauge("raybundle_ready", "1 once the first iteration is done", ready ? 1.0 : 0.0);
    out.gauge("raybundle_viewers", "Connected viewers", static_cast<double>(gate.present()));
    out.counter("raybundle_frames_queued_total", "Frames handed over for sending",
                count(counters.frames_queued));
    out.counter("raybundle_frames_replaced_total", "Frames dropped for a newer one",
                count(counters.frames_replaced));
    out.counter("raybundle_sent_bytes_total", "WebSocket payload sent", count(counters.bytes_sent));
    out.counter("raybundle_received_bytes_total", "WebSocket payload received",
                count(counters.bytes_received));
    out.counter("raybundle_connections_refused_total",
                "Connections refused by origin, path or number",
                count(counters.connections_refused));
    out.counter("raybundle_rest_requests_total", "Requests below /api",
                count(counters.rest_requests));
    out.counter("raybundle_wrong_tokens_total", "Wrong tokens, of viewers and of HTTP requests",
                static_cast<double>(gate.wrong_tokens()));
    out.counter("raybundle_audit_failures_total", "Lines that could not be added to the audit log",
                settings.audit ? static_cast<double>(settings.audit->failures()) : 0.0);
    add_queue_delays(viewers, out);
    std::string text = out.text();
    const std::lock_guard lock(metrics_mutex_);
    if (metrics_source_) {
        text += metrics_source_();
    }
    return text;
}

}  // namespace raybundle
