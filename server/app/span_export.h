// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "options/cli_options.h"
#include "telemetry/span_exporter.h"

namespace raybundle {

/// What sends traces where the options or the environment ask for them; null: nobody does. Throws
/// UsageError.
std::unique_ptr<SpanExporter> make_span_exporter(const Options& options);

/// Prometheus text; all 0 where there is none.
std::string span_metrics(const SpanExporter* exporter);

}  // namespace raybundle
