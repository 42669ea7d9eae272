// SPDX-License-Identifier: Apache-2.0
#include "net/http/metrics_text.h"

#include <fmt/core.h>

#include <cmath>

namespace raybundle {
namespace {

/// Whole numbers without a fraction; NaN and infinities in the words of the format.
std::string number(double value) {
    if (std::isnan(value)) {
        return "NaN";
    }
    if (std::isinf(value)) {
        return value > 0.0 ? "+Inf" : "-Inf";
    }
    return fmt::format("{}", value);
}

}  // namespace

void MetricsText::gauge(std::string_view name, std::string_view help, double value) {
    family(name, "gauge", help);
    sample(name, "", value);
}

void MetricsText::counter(std::string_view name, std::string_view help, double value) {
    family(name, "counter", help);
    sample(name, "", value);
}

void MetricsText::family(std::string_view name, std::string_view type, std::string_view help) {
    text_ += fmt::format("# HELP {} {}\n# TYPE {} {}\n", name, help, name, type);
}

void MetricsText::sample(std::string_view name, std::string_view labels, double value) {
    const std::string braces = labels.empty() ? "" : "{" + std::string(labels) + "}";
    text_ += fmt::format("{}{} {}\n", name, braces, number(value));
}

}  // namespace raybundle
