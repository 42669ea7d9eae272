// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iterator>
#include <mutex>
#include <utility>
#include <vector>

#include "telemetry/span.h"

namespace raybundle {

/// Keeps what is submitted.
class CollectedSpans : public SpanSink {
  public:
    void submit(std::vector<Span> spans) override {
        const std::lock_guard lock(mutex_);
        spans_.insert(spans_.end(), std::make_move_iterator(spans.begin()),
                      std::make_move_iterator(spans.end()));
    }
    [[nodiscard]] std::vector<Span> spans() const {
        const std::lock_guard lock(mutex_);
        return spans_;
    }

  private:
    mutable std::mutex mutex_;
    std::vector<Span> spans_;
};

}  // namespace raybundle
