// SPDX-License-Identifier: Apache-2.0
#include "telemetry/trace_context.h"

#include <sys/random.h>

#include <algorithm>
#include <random>

namespace raybundle {
namespace {

constexpr std::size_t traceparent_letters = 55;
constexpr std::uint8_t sampled_flag = 1;

int digit_of(char letter) {
    if (letter >= '0' && letter <= '9') {
        return letter - '0';
    }
    return letter >= 'a' && letter <= 'f' ? letter - 'a' + 10 : -1;
}

/// False unless `text` is twice as many lower-case digits.
bool read_hex(std::string_view text, std::span<std::uint8_t> bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const int high = digit_of(text[2 * i]);
        const int low = digit_of(text[2 * i + 1]);
        if (high < 0 || low < 0) {
            return false;
        }
        bytes[i] = static_cast<std::uint8_t>(16 * high + low);
    }
    return true;
}

bool all_zero(std::span<const std::uint8_t> bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; });
}

template <typename Id>
Id random_id() {
    Id id{};
    while (all_zero(id)) {
        if (getrandom(id.data(), id.size(), 0) != static_cast<ssize_t>(id.size())) {
            std::random_device device;
            std::generate(id.begin(), id.end(),
                          [&device] { return static_cast<std::uint8_t>(device()); });
        }
    }
    return id;
}

}  // namespace

std::optional<TraceContext> parse_traceparent(std::string_view text) {
    if (text.size() < traceparent_letters || text[2] != '-' || text[35] != '-' || text[52] != '-') {
        return std::nullopt;
    }
    TraceContext context;
    std::array<std::uint8_t, 1> version{};
    std::array<std::uint8_t, 1> flags{};
    if (!read_hex(text.substr(0, 2), version) || !read_hex(text.substr(3, 32), context.trace) ||
        !read_hex(text.substr(36, 16), context.span) || !read_hex(text.substr(53, 2), flags)) {
        return std::nullopt;
    }
    // Later versions may have more behind another dash.
    const bool ends = version[0] == 0
                          ? text.size() == traceparent_letters
                          : text.size() == traceparent_letters || text[traceparent_letters] == '-';
    if (version[0] == 0xFF || !ends || all_zero(context.trace) || all_zero(context.span)) {
        return std::nullopt;
    }
    context.sampled = (flags[0] & sampled_flag) != 0;
    return context;
}

std::string traceparent_of(const TraceContext& context) {
    return "00-" + hex_of(context.trace) + "-" + hex_of(context.span) +
           (context.sampled ? "-01" : "-00");
}

std::string hex_of(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : bytes) {
        text += digits[byte >> 4U];
        text += digits[byte & 15U];
    }
    return text;
}

TraceId random_trace_id() {
    return random_id<TraceId>();
}

SpanId random_span_id() {
    return random_id<SpanId>();
}

}  // namespace raybundle
