// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/span_export.h"
#include "net/server.h"
#include "session/changes/change_log.h"
#include "session/render_loop.h"

namespace raybundle {

/// Lets the server ask a loop for its metrics, and whether changes can be saved, while all exist.
class MetricsSource {
  public:
    /// spans: null where nobody wants traces.
    MetricsSource(Server& server, const RenderLoop& loop, const ChangeLog& log,
                  const SpanExporter* spans)
        : server_(server), loop_(loop), log_(log), spans_(spans) {
        use();
    }
    /// Answers from now on.
    void use() {
        server_.set_metrics_source([this] { return loop_.metrics() + span_metrics(spans_); });
        server_.set_editable_source([this] { return log_.working(); });
    }
    ~MetricsSource() {
        server_.set_metrics_source({});
        server_.set_editable_source({});
    }
    MetricsSource(const MetricsSource&) = delete;
    MetricsSource& operator=(const MetricsSource&) = delete;

  private:
    Server& server_;
    const RenderLoop& loop_;
    const ChangeLog& log_;
    const SpanExporter* spans_;
};

}  // namespace raybundle
