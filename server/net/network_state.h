// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "net/access/gate.h"
#include "net/http/content_store.h"
#include "net/http/document.h"
#include "net/http/snapshot_store.h"
#include "net/http/upload.h"
#include "net/server_settings.h"
#include "net/ws/inbox.h"
#include "net/ws/viewer_table.h"

namespace raybundle {

/// Counters of the network layer since it started, for /metrics.
struct NetworkCounters {
    std::atomic<std::uint64_t> frames_queued{0};
    std::atomic<std::uint64_t> frames_replaced{0};  ///< dropped for a newer one
    std::atomic<std::uint64_t> bytes_sent{0};       ///< WebSocket payload
    std::atomic<std::uint64_t> bytes_received{0};   ///< WebSocket payload
    std::atomic<std::uint64_t> connections_refused{0};
    std::atomic<std::uint64_t> rest_requests{0};  ///< below /api
};

/// What the network thread and the callers of Server share. Everything in it is thread-safe.
struct NetworkState {
    explicit NetworkState(ServerSettings server_settings)
        : settings(std::move(server_settings)),
          gate(settings.max_viewers, settings.access),
          snapshots(settings.max_snapshot_bytes) {}

    const ServerSettings settings;
    Gate gate;
    Inbox inbox;
    ViewerTable viewers;
    NetworkCounters counters;
    SnapshotStore snapshots;
    ContentStore contents;
    std::atomic<bool> ready{false};

    void set_metrics_source(std::function<std::string()> source);
    void set_editable_source(std::function<bool()> source);
    /// Whether changes can be saved; true where nobody says.
    [[nodiscard]] bool editable() const;
    void set_photometry_source(std::function<std::string()> source);
    /// JSON of the photometric files; nothing where there are none.
    [[nodiscard]] std::optional<std::string> photometry() const;
    void set_presence(std::string json);
    /// The message of presence that viewers have been told last, as JSON.
    [[nodiscard]] std::string presence() const;
    void set_upload_factory(UploadFactory factory);
    /// Null where there is no factory or it cannot begin.
    [[nodiscard]] std::unique_ptr<Upload> begin_upload(const std::string& name) const;
    /// Replaces the source of documents; an empty one takes away that of its owner alone.
    void set_document_source(const void* owner, DocumentSource source);
    /// 503 where nobody makes documents.
    void make_document(DocumentRequest request, std::function<void(DocumentResult)> done) const;

    /// Prometheus text: the network's own figures, then those of the metrics source.
    [[nodiscard]] std::string metrics() const;

  private:
    mutable std::mutex metrics_mutex_;
    std::function<std::string()> metrics_source_;
    std::function<bool()> editable_source_;
    mutable std::mutex upload_mutex_;
    std::function<std::string()> photometry_source_;
    UploadFactory upload_factory_;
    mutable std::mutex presence_mutex_;
    std::string presence_ = R"({"presence":{"viewers":[]}})";
    mutable std::mutex document_mutex_;
    DocumentSource document_source_;
    const void* document_owner_ = nullptr;
};

}  // namespace raybundle
