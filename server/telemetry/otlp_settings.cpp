// SPDX-License-Identifier: Apache-2.0
#include "telemetry/otlp_settings.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>

namespace raybundle {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

constexpr const char* endpoint_name = "OTEL_EXPORTER_OTLP_ENDPOINT";
constexpr const char* traces_endpoint_name = "OTEL_EXPORTER_OTLP_TRACES_ENDPOINT";
constexpr const char* headers_name = "OTEL_EXPORTER_OTLP_HEADERS";
constexpr const char* protocol_name = "OTEL_EXPORTER_OTLP_PROTOCOL";
constexpr const char* timeout_name = "OTEL_EXPORTER_OTLP_TIMEOUT";
constexpr const char* certificate_name = "OTEL_EXPORTER_OTLP_CERTIFICATE";
constexpr const char* service_name = "OTEL_SERVICE_NAME";
constexpr const char* resource_name = "OTEL_RESOURCE_ATTRIBUTES";

void ignore(const char* name, const char* reason) {
    spdlog::warn("{} is ignored: {}", name, reason);
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') {
        text.remove_prefix(1);
    }
    while (!text.empty() && text.back() == ' ') {
        text.remove_suffix(1);
    }
    return text;
}

/// With %20 and the like decoded.
std::string decoded(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned code = 0;
        const char* const digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
            plain += static_cast<char>(code);
            i += 2;
        } else {
            plain += text[i];
        }
    }
    return plain;
}

/// Of "key1=value1,key2=value2"; what is no such pair is left out.
Pairs pairs_of(std::string_view text) {
    Pairs pairs;
    while (!text.empty()) {
        const std::size_t comma = text.find(',');
        const std::string_view pair = text.substr(0, comma);
        const std::size_t equals = pair.find('=');
        if (equals != std::string_view::npos && !trimmed(pair.substr(0, equals)).empty()) {
            pairs.emplace_back(trimmed(pair.substr(0, equals)),
                               decoded(trimmed(pair.substr(equals + 1))));
        }
        text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
    }
    return pairs;
}

bool is_header(const std::pair<std::string, std::string>& pair) {
    const auto of_name = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    };
    const auto of_value = [](char c) { return c >= ' ' && c <= '~'; };
    return std::all_of(pair.first.begin(), pair.first.end(), of_name) &&
           std::all_of(pair.second.begin(), pair.second.end(), of_value);
}

/// Where traces are taken in at a base address.
std::optional<HttpUrl> traces_at(std::string_view base) {
    auto url = parse_http_url(base);
    if (url) {
        url->path += url->path.ends_with('/') ? "v1/traces" : "/v1/traces";
    }
    return url;
}

class Reader {
  public:
    explicit Reader(const ProcessEnvironment& environment) : environment_(environment) {}

    /// Empty where it is not set.
    [[nodiscard]] std::string_view text(const char* name) const {
        const char* const value = environment_(name);
        return value == nullptr ? std::string_view() : std::string_view(value);
    }

    [[nodiscard]] std::optional<HttpUrl> url() const {
        if (text("OTEL_SDK_DISABLED") == "true" || text("OTEL_TRACES_EXPORTER") == "none") {
            return std::nullopt;
        }
        const bool own = !text(traces_endpoint_name).empty();
        const char* const name = own ? traces_endpoint_name : endpoint_name;
        if (text(name).empty()) {
            return std::nullopt;
        }
        if (const auto protocol = text(protocol_name);
            !protocol.empty() && protocol != "http/protobuf") {
            ignore(name, "raybundle speaks http/protobuf alone");
            return std::nullopt;
        }
        auto url = own ? parse_http_url(text(name)) : traces_at(text(name));
        if (!url) {
            ignore(name, "it is no http:// or https:// address");
        }
        return url;
    }

    void read_timeout(OtlpSettings& settings) const {
        const std::string_view value = text(timeout_name);
        long milliseconds = 0;
        const char* const end = value.data() + value.size();
        if (value.empty()) {
            return;
        }
        if (std::from_chars(value.data(), end, milliseconds).ptr == end && milliseconds > 0 &&
            milliseconds <= 60000) {
            settings.timeout = std::chrono::milliseconds(milliseconds);
        } else {
            ignore(timeout_name, "it is no number of milliseconds from 1 to 60000");
        }
    }

    void read_headers(OtlpSettings& settings) const {
        for (auto& pair : pairs_of(text(headers_name))) {
            if (is_header(pair)) {
                settings.headers.push_back(std::move(pair));
            } else {
                ignore(headers_name, "it has letters that no header has");
            }
        }
    }

    void read_source(SpanSource& source) const {
        for (auto& [key, value] : pairs_of(text(resource_name))) {
            if (key == "service.name") {
                source.service = value;
            } else {
                source.attributes.emplace_back(key, value);
            }
        }
        if (const std::string_view name = text(service_name); !name.empty()) {
            source.service = name;
        }
    }

  private:
    const ProcessEnvironment& environment_;
};

}  // namespace

std::optional<OtlpSettings> otlp_settings(const std::string& option,
                                          const ProcessEnvironment& environment) {
    const Reader reader(environment);
    const auto url = option.empty() ? reader.url() : traces_at(option);
    if (!url) {
        return std::nullopt;
    }
    OtlpSettings settings;
    settings.url = *url;
    settings.ca_file = reader.text(certificate_name);
    reader.read_timeout(settings);
    reader.read_headers(settings);
    reader.read_source(settings.source);
    return settings;
}

}  // namespace raybundle
