// SPDX-License-Identifier: Apache-2.0
#include "app/span_export.h"

#include <cstdlib>
#include <stdexcept>

#include "net/http/metrics_text.h"

namespace raybundle {

std::unique_ptr<SpanExporter> make_span_exporter(const Options& options) {
    auto settings = otlp_settings(options.serve.otlp, [](const char* name) -> const char* {
        return std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
    });
    try {
        return settings ? std::make_unique<SpanExporter>(std::move(*settings)) : nullptr;
    } catch (const std::runtime_error& error) {
        throw UsageError(std::string("--otlp: ") + error.what());
    }
}

std::string span_metrics(const SpanExporter* exporter) {
    const SpanExporter::Figures figures =
        exporter == nullptr ? SpanExporter::Figures{} : exporter->figures();
    MetricsText out;
    out.counter("raybundle_trace_spans_total", "Spans of traces that a collector has taken",
                static_cast<double>(figures.exported));
    out.counter("raybundle_trace_spans_dropped_total", "Spans that no collector has taken",
                static_cast<double>(figures.dropped));
    out.counter("raybundle_trace_failures_total", "Attempts to send spans that have failed",
                static_cast<double>(figures.failures));
    return out.text();
}

}  // namespace raybundle
