// SPDX-License-Identifier: Apache-2.0
#include "scene/photometry/colour_rendering.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "scene/photometry/ies_text.h"

namespace raybundle {
namespace {

struct RenderingGroup {
    std::string_view name;
    ColourRendering range;
};

/// DIN 5035-2, the groups of EULUMDAT.
constexpr std::array<RenderingGroup, 6> rendering_groups{{{"1A", {90.0F, 100.0F}},
                                                          {"1B", {80.0F, 89.0F}},
                                                          {"2A", {70.0F, 79.0F}},
                                                          {"2B", {60.0F, 69.0F}},
                                                          {"3", {40.0F, 59.0F}},
                                                          {"4", {20.0F, 39.0F}}}};

bool is_decimal(char c) {
    return c >= '0' && c <= '9';
}

/// Numbers that stand in a text, with one decimal separator each, and where each begins and ends.
struct StatedNumber {
    float value = 0.0F;
    std::size_t begin = 0, end = 0;
};
std::vector<StatedNumber> stated_numbers(const std::string& text) {
    std::vector<StatedNumber> found;
    for (std::size_t at = 0; at < text.size();) {
        if (!is_decimal(text[at])) {
            ++at;
            continue;
        }
        StatedNumber number{0.0F, at, at};
        const char* const end = text.data() + text.size();
        const auto [last, error] = std::from_chars(text.data() + at, end, number.value);
        number.end = static_cast<std::size_t>(last - text.data());
        at = std::max(number.end, at + 1);
        if (error == std::errc()) {
            found.push_back(number);
        }
    }
    return found;
}

/// Whether a number stands behind the name of what it is, maybe with a sign between.
bool is_named(const std::string& text, const StatedNumber& number) {
    const std::size_t last = text.find_last_not_of(">=:(\xE2\x89\xA5", number.begin - 1);
    const std::string_view before = number.begin == 0 || last == std::string::npos
                                        ? std::string_view()
                                        : std::string_view(text).substr(0, last + 1);
    return before.ends_with("RA") || before.ends_with("CRI");
}

/// Whether it is a colour temperature, a power, a voltage or a flux.
bool has_other_unit(const std::string& text, const StatedNumber& number) {
    const std::string_view behind = std::string_view(text).substr(number.end);
    return behind.starts_with("K") || behind.starts_with("W") || behind.starts_with("V") ||
           behind.starts_with("LM");
}

/// Of the numbers that may be Ra the one that is named so, else the first; their end: none.
std::vector<StatedNumber>::const_iterator likely(const std::vector<StatedNumber>& numbers,
                                                 const std::string& text) {
    const auto named = std::find_if(numbers.begin(), numbers.end(),
                                    [&](const auto& one) { return is_named(text, one); });
    return named != numbers.end()
               ? named
               : std::find_if(numbers.begin(), numbers.end(),
                              [&](const auto& one) { return !has_other_unit(text, one); });
}

/// A light colour as lamps have it: 8 of 840 stands for Ra of 80 to 89, and 40 for 4000 K.
std::optional<ColourRendering> of_light_colour(float value) {
    const int tens = static_cast<int>(value / 100.0F);
    return value > 100.0F && value < 1000.0F && tens >= 2
               ? std::optional(
                     ColourRendering{10.0F * static_cast<float>(tens),
                                     tens == 9 ? 100.0F : 10.0F * static_cast<float>(tens) + 9.0F})
               : std::nullopt;
}

}  // namespace

std::optional<ColourRendering> read_colour_rendering(std::string_view line) {
    std::string text = compact(line);
    std::replace(text.begin(), text.end(), ',', '.');
    std::optional<ColourRendering> group;
    for (const auto& [name, range] : rendering_groups) {
        const bool begins = text.starts_with(name) &&
                            (text.size() == name.size() ||
                             (!is_decimal(text[name.size()]) && text[name.size()] != '.'));
        if (begins) {
            group = range;
            text.erase(0, name.size());
            break;
        }
    }
    const std::vector<StatedNumber> numbers = stated_numbers(text);
    const auto place = likely(numbers, text);
    if (place == numbers.end()) {
        return group;
    }
    const StatedNumber& first = *place;
    if (const auto colour = of_light_colour(first.value)) {
        return group ? group : colour;
    }
    // 1 and 2 are lamps or groups without their letter, and 0 stands for nothing.
    if (first.value < 20.0F || first.value > 100.0F) {
        return group;
    }
    const auto next = place + 1;
    if (next != numbers.end() && next->value > first.value && next->value <= 100.0F &&
        text.substr(first.end, next->begin - first.end) == "-") {
        return ColourRendering{first.value, next->value};
    }
    const bool limit = text.substr(0, first.begin).find('>') != std::string::npos ||
                       text.substr(0, first.begin).find("\xE2\x89\xA5") != std::string::npos ||
                       text.substr(first.end).starts_with("+");
    return ColourRendering{first.value, limit ? 100.0F : first.value};
}

std::optional<ColourRendering> keyword_colour_rendering(std::string_view line) {
    const std::string text = compact(line);
    const std::size_t end = text.find(']');
    if (!text.starts_with("[") || end == std::string::npos) {
        return std::nullopt;
    }
    std::string keyword;
    for (const char c : text.substr(1, end - 1)) {
        keyword += c >= 'A' && c <= 'Z' ? std::string(1, c) : "";
    }
    for (const char* const known : {"CRI", "RA", "CRIRA", "COLORRENDERING", "COLOURRENDERING",
                                    "COLORRENDERINGINDEX", "COLOURRENDERINGINDEX"}) {
        if (keyword == known) {
            return read_colour_rendering(text.substr(end + 1));
        }
    }
    return std::nullopt;
}

std::string text_of(const std::optional<ColourRendering>& known) {
    if (!known) {
        return "";
    }
    return known->most > known->least ? fmt::format("{:g} to {:g}", known->least, known->most)
                                      : fmt::format("{:g}", known->least);
}

}  // namespace raybundle
