// SPDX-License-Identifier: Apache-2.0
#include "research/plot/svg_text.h"

#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace raybundle {
namespace {

constexpr const char* replacement = "\xEF\xBF\xBD";  // U+FFFD

/// Bytes of the UTF-8 sequence at the beginning of the text; 0: there is none. Overlong forms and
/// surrogates do not count (Unicode 15, table 3-7).
std::size_t sequence_length(std::string_view text) {
    const auto byte = [text](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const unsigned lead = byte(0);
    const auto continues = [&](std::size_t i) { return byte(i) >= 0x80U && byte(i) <= 0xBFU; };
    if (lead < 0x80U) {
        return 1;
    }
    if (lead >= 0xC2U && lead <= 0xDFU) {
        return continues(1) ? 2 : 0;
    }
    if (lead >= 0xE0U && lead <= 0xEFU) {
        const bool valid =
            !(lead == 0xE0U && byte(1) < 0xA0U) && !(lead == 0xEDU && byte(1) > 0x9FU);
        return valid && continues(1) && continues(2) ? 3 : 0;
    }
    if (lead >= 0xF0U && lead <= 0xF4U) {
        const bool valid =
            !(lead == 0xF0U && byte(1) < 0x90U) && !(lead == 0xF4U && byte(1) > 0x8FU);
        return valid && continues(1) && continues(2) && continues(3) ? 4 : 0;
    }
    return 0;
}

std::string escaped_ascii(char c) {
    switch (c) {
        case '&':
            return "&amp;";
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '"':
            return "&quot;";
        case '\'':
            return "&#39;";
        default:
            return static_cast<unsigned char>(c) < 0x20U && c != '\t' && c != '\n' && c != '\r'
                       ? replacement
                       : std::string(1, c);
    }
}

}  // namespace

std::string xml_escaped(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = sequence_length(text);
        if (length == 0) {
            result += replacement;
        } else if (length == 1) {
            result += escaped_ascii(text.front());
        } else {
            const std::string_view sequence = text.substr(0, length);
            const bool forbidden = sequence == "\xEF\xBF\xBE" || sequence == "\xEF\xBF\xBF";
            result += forbidden ? std::string_view(replacement) : sequence;
        }
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return result;
}

std::string svg_number(double value) {
    if (!std::isfinite(value)) {
        throw std::invalid_argument("a plot has a coordinate that is not finite");
    }
    std::string text = fmt::format("{:.2f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') {
        text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

std::string readable_number(double value) {
    const double magnitude = std::abs(value);
    if (magnitude >= 100.0 && magnitude < 1e6) {
        return fmt::format("{:.0f}", value);
    }
    return fmt::format("{:.3g}", value);
}

}  // namespace raybundle
