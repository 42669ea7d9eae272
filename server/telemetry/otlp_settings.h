// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "telemetry/http_post.h"
#include "telemetry/otlp_message.h"

namespace raybundle {

/// Where traces go.
struct OtlpSettings {
    HttpUrl url;
    HttpPost::Headers headers;
    std::string ca_file;
    SpanSource source;
    std::chrono::milliseconds timeout{10000};     ///< of one attempt
    std::chrono::milliseconds batch_time{1000};   ///< spans wait so long for others to go with them
    std::chrono::milliseconds first_pause{1000};  ///< before a second attempt; then twice as long
};

/// Value of a variable of the environment, or null.
using ProcessEnvironment = std::function<const char*(const char* name)>;

/// What `--otlp URL` and the environment ask for; nothing: no traces. The option wins over
/// OTEL_EXPORTER_OTLP_ENDPOINT. Variables that do not fit are logged and ignored, as OpenTelemetry
/// has it: https://opentelemetry.io/docs/specs/otel/protocol/exporter/.
std::optional<OtlpSettings> otlp_settings(const std::string& option,
                                          const ProcessEnvironment& environment);

}  // namespace raybundle
