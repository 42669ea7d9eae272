// SPDX-License-Identifier: Apache-2.0
#include "scene/photometry/ies_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

/// UTF-16 as Latin-1, '?' for all else. high: offset of the upper byte.
std::string from_utf16(std::string_view bytes, std::size_t high) {
    std::string text;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        text += bytes[i + high] == '\0' ? bytes[i + 1 - high] : '?';
    }
    return text;
}

/// Whether the text begins with two ASCII characters of UTF-16 and no mark says so. high: as above.
bool looks_like_utf16(std::string_view bytes, std::size_t high) {
    const auto ascii = [&](std::size_t i) {
        const auto low = static_cast<std::uint8_t>(bytes[i + 1 - high]);
        return bytes[i + high] == '\0' && low > 0 && low < 0x80;
    };
    return bytes.size() >= 4 && ascii(0) && ascii(2);
}

/// What separates words but for the end of a line: control characters (DOS ends files with
/// Control-Z, and programs pad them with zeros), and the no-break space of Latin-1 and UTF-8.
bool is_space(std::string_view bytes, std::size_t i) {
    constexpr std::uint8_t no_break = 0xA0;
    const auto c = static_cast<std::uint8_t>(bytes[i]);
    const bool first_of_two =
        c == 0xC2 && i + 1 < bytes.size() && static_cast<std::uint8_t>(bytes[i + 1]) == no_break;
    // Behind another byte above ASCII it is a part of a letter of UTF-8, as of "à".
    const auto before = static_cast<std::uint8_t>(i > 0 ? bytes[i - 1] : '\0');
    const bool alone = c == no_break && (before < 0x80 || before == 0xC2);
    return (c < 0x20 && c != '\n' && c != '\t') || c == 0x7F || alone || first_of_two;
}

}  // namespace

std::string plain_photometric_text(const std::string& file, std::string_view bytes) {
    constexpr std::size_t max_bytes = 16U << 20U;
    if (bytes.size() > max_bytes) {
        IesReader(file, {}).fail(
            fmt::format("more than {} bytes, the limit of photometric files", max_bytes));
    }
    std::string decoded;
    if (bytes.starts_with("\xFF\xFE")) {
        decoded = from_utf16(bytes.substr(2), 1);
        bytes = decoded;
    } else if (bytes.starts_with("\xFE\xFF")) {
        decoded = from_utf16(bytes.substr(2), 0);
        bytes = decoded;
    } else if (bytes.starts_with("\xEF\xBB\xBF")) {
        bytes.remove_prefix(3);
    } else if (looks_like_utf16(bytes, 1) || looks_like_utf16(bytes, 0)) {
        decoded = from_utf16(bytes, looks_like_utf16(bytes, 1) ? 1 : 0);
        bytes = decoded;
    }
    std::string text;
    text.reserve(bytes.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const bool pair = bytes[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n';
        if (!pair) {
            text += bytes[i] == '\r' ? '\n' : is_space(bytes, i) ? ' ' : bytes[i];
        }
    }
    return text;
}

std::string compact(std::string_view line) {
    std::string result;
    for (const char c : line) {
        if (c != ' ' && c != '\t') {
            result += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        }
    }
    return result;
}

void IesReader::fail(int line, const std::string& reason) const {
    throw SceneError(file_, fmt::format("line {}", line), reason);
}

std::string_view IesReader::next_line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    return line;
}

bool IesReader::is_blank(char c) const {
    return c == ' ' || c == '\t' || c == '\n' || (c == ',' && !decimal_commas_);
}

void IesReader::skip_blanks() {
    while (!rest_.empty() && is_blank(rest_.front())) {
        line_ += rest_.front() == '\n' ? 1 : 0;
        rest_.remove_prefix(1);
    }
}

double IesReader::number(const std::string& what, double low, double high) {
    skip_blanks();
    if (rest_.empty()) {
        fail(fmt::format("the file ends where {} should be", what));
    }
    std::size_t length = 0;
    while (length < rest_.size() && !is_blank(rest_[length])) {
        ++length;
    }
    std::string digits(rest_.substr(0, length));
    std::replace(digits.begin(), digits.end(), ',', '.');
    if (digits.front() == '+') {
        digits.erase(0, 1);
    }
    double value = 0.0;
    const char* last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(digits.data(), last, value);
    if (error != std::errc() || end != last) {
        fail(fmt::format("{} is not a number", what));
    }
    if (!(value >= low && value <= high)) {
        fail(fmt::format("{} is {}, not in [{}, {}]", what, value, low, high));
    }
    rest_.remove_prefix(length);
    return value;
}

std::size_t IesReader::count(const std::string& what, std::size_t high) {
    const double value = number(what, 1.0, static_cast<double>(high));
    if (value != std::floor(value)) {
        fail(fmt::format("{} is {}, not an integer", what, value));
    }
    return static_cast<std::size_t>(value);
}

std::vector<double> IesReader::ascending(const std::string& what, std::size_t number_of, double low,
                                         double high) {
    std::vector<double> values;
    for (std::size_t i = 0; i < number_of; ++i) {
        values.push_back(number(what, low, high));
        if (i > 0 && values[i] <= values[i - 1]) {
            fail(fmt::format("{} {} is not above the one before it, {}", what, values[i],
                             values[i - 1]));
        }
    }
    return values;
}

bool IesReader::has_number() {
    const IesReader before = *this;
    skip_blanks();
    if (!rest_.empty() &&
        std::string_view("0123456789+-.").find(rest_.front()) != std::string::npos) {
        return true;
    }
    rest_ = before.rest_;
    line_ = before.line_;
    return false;
}

}  // namespace raybundle
