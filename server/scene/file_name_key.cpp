// SPDX-License-Identifier: Apache-2.0
#include "scene/file_name_key.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "scene/contact/canonical_pairs.h"

namespace raybundle {
namespace {

/// Takes the next character off a text. Bytes that are no UTF-8 count as characters of their own,
/// beyond those of Unicode.
char32_t next_character(std::string_view& text) {
    constexpr char32_t no_utf8 = 0x110000;
    const auto lead = static_cast<std::uint8_t>(text.front());
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xC0 ? 0
                               : lead < 0xE0 ? 2
                               : lead < 0xF0 ? 3
                                             : 4;
    char32_t character = length < 2 ? lead : lead & (0x7FU >> length);
    bool valid = length > 0 && length <= text.size();
    for (std::size_t i = 1; valid && i < length; ++i) {
        const auto next = static_cast<std::uint8_t>(text[i]);
        valid = (next & 0xC0U) == 0x80U;
        character = character << 6U | (next & 0x3FU);
    }
    text.remove_prefix(valid ? length : 1);
    return valid ? character : no_utf8 + lead;
}

void append_utf8(char32_t character, std::string& text) {
    const auto add = [&](char32_t byte) { text += static_cast<char>(byte); };
    if (character < 0x80 || character >= 0x110000) {
        add(character & 0xFFU);
    } else if (character < 0x800) {
        add(0xC0U | character >> 6U);
        add(0x80U | (character & 0x3FU));
    } else {
        if (character < 0x10000) {
            add(0xE0U | character >> 12U);
        } else {
            add(0xF0U | character >> 18U);
            add(0x80U | (character >> 12U & 0x3FU));
        }
        add(0x80U | (character >> 6U & 0x3FU));
        add(0x80U | (character & 0x3FU));
    }
}

bool is_in(char32_t character, char32_t first, char32_t last) {
    return character >= first && character <= last;
}

/// Of characters that have no decomposition.
char32_t lower_case(char32_t c) {
    if (is_in(c, 'A', 'Z') || (is_in(c, 0xC6, 0xDE) && c != 0xD7) || is_in(c, 0x391, 0x3A9) ||
        is_in(c, 0x410, 0x42F)) {
        return c + 0x20;
    }
    if (is_in(c, 0x400, 0x40F)) {
        return c + 0x50;
    }
    // Latin Extended-A has pairs, upper case first.
    const bool even = is_in(c, 0x100, 0x137) || is_in(c, 0x14A, 0x177) || is_in(c, 0x460, 0x481);
    const bool odd = is_in(c, 0x139, 0x148) || is_in(c, 0x179, 0x17E);
    return (even && c % 2 == 0) || (odd && c % 2 == 1) ? c + 1 : c;
}

/// Chapter 3.12 of the Unicode Standard: syllables are numbered by their two or three jamos.
void append_hangul(char32_t syllable, std::string& key) {
    constexpr char32_t tails = 28, vowels = 21;
    append_utf8(0x1100 + syllable / (tails * vowels), key);
    append_utf8(0x1161 + syllable % (tails * vowels) / tails, key);
    if (syllable % tails != 0) {
        append_utf8(0x11A7 + syllable % tails, key);
    }
}

void append_decomposed(char32_t character, std::string& key) {
    constexpr char32_t first_syllable = 0xAC00, last_syllable = 0xD7A3;
    if (is_in(character, first_syllable, last_syllable)) {
        append_hangul(character - first_syllable, key);
        return;
    }
    const auto pair = std::lower_bound(
        canonical_pairs.begin(), canonical_pairs.end(), character,
        [](const CanonicalPair& row, char32_t value) { return row.composed < value; });
    if (pair == canonical_pairs.end() || pair->composed != character) {
        append_utf8(lower_case(character), key);
        return;
    }
    append_decomposed(pair->base, key);
    append_utf8(pair->mark, key);
}

}  // namespace

std::string file_name_key(std::string_view utf8) {
    std::string key;
    while (!utf8.empty()) {
        append_decomposed(next_character(utf8), key);
    }
    return key;
}

}  // namespace raybundle
