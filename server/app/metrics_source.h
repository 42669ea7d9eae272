// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "net/server.h"
#include "session/changes/change_log.h"
#include "session/render_loop.h"

namespace raybundle {

/// Lets the server ask a loop for its metrics, and whether changes can be saved, while all exist.
class MetricsSource {
  public:
    MetricsSource(Server& server, const RenderLoop& loop, const ChangeLog& log)
        : server_(server), loop_(loop), log_(log) {
        use();
    }
    /// Answers from now on.
    void use() {
        server_.set_metrics_source([this] { return loop_.metrics(); });
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
};

}  // namespace raybundle
