// SPDX-License-Identifier: Apache-2.0
// LM-63 lets commas separate numbers, and has points in them. Programs of other languages write
// decimal commas. The counts of angles say how many numbers there are, and so which is meant.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "scene/photometry/ies_text.h"

namespace raybundle {
namespace {

constexpr std::size_t max_tilt_angles = 1000;
constexpr std::size_t numbers_before_angles = 13;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// What stands between blanks: its number of commas, and whether it is D,D with digits D.
struct Field {
    std::string_view text;
    std::size_t commas = 0;

    [[nodiscard]] bool is_decimal() const {
        const std::size_t comma = text.find(',');
        return commas == 1 && comma > 0 && comma + 1 < text.size() && is_digit(text[comma - 1]) &&
               is_digit(text[comma + 1]);
    }
    /// Whether it could be an integer with a separator of thousands.
    [[nodiscard]] bool could_be_thousands() const {
        const std::size_t comma = text.find(',');
        const std::string_view whole = text.substr(0, comma);
        return text.size() - comma == 4 && whole.size() <= 3 && whole != "0" &&
               std::all_of(text.begin() + static_cast<std::ptrdiff_t>(comma) + 1, text.end(),
                           is_digit);
    }
};

/// Counts the numbers of the text up to the first word that is none, either way.
class Census {
  public:
    explicit Census(std::string_view text) {
        int line = 0;
        for (std::size_t i = 0; i < text.size();) {
            if (text[i] == ' ' || text[i] == '\t' || text[i] == '\n') {
                line += text[i++] == '\n' ? 1 : 0;
                continue;
            }
            std::size_t end = i;
            while (end < text.size() && text[end] != ' ' && text[end] != '\t' &&
                   text[end] != '\n') {
                ++end;
            }
            Field field{text.substr(i, end - i), 0};
            if (!is_digit(field.text[0]) &&
                std::string_view("+-.,").find(field.text[0]) == std::string_view::npos) {
                return;
            }
            field.commas =
                static_cast<std::size_t>(std::count(field.text.begin(), field.text.end(), ','));
            add(field, line);
            i = end;
        }
    }

    [[nodiscard]] bool any_decimal() const { return !first_decimal_.empty(); }
    [[nodiscard]] bool surely_decimal() const { return surely_decimal_; }
    [[nodiscard]] int decimal_line() const { return decimal_line_; }
    [[nodiscard]] std::string_view first_decimal() const { return first_decimal_; }
    [[nodiscard]] std::size_t with_decimals() const { return with_decimals_; }
    [[nodiscard]] std::size_t with_separators() const { return with_separators_; }

    /// How many numbers there should be, by the counts of angles. Nothing where these are not to be
    /// read.
    [[nodiscard]] std::optional<std::size_t> expected(bool separators, bool tilt) const {
        const std::vector<std::string_view>& numbers = separators ? separated_ : fields_;
        std::size_t first = 0;
        if (tilt) {
            const auto pairs = integer(numbers, 1);
            if (!pairs || *pairs > max_tilt_angles) {
                return std::nullopt;
            }
            first = 2 + 2 * *pairs;
        }
        const auto rows = integer(numbers, first + 3);
        const auto columns = integer(numbers, first + 4);
        if (!rows || !columns || *rows > 1U << 20U || *columns > 1U << 20U) {
            return std::nullopt;
        }
        return first + numbers_before_angles + *rows + *columns + *rows * *columns;
    }

  private:
    void add(const Field& field, int line) {
        constexpr std::size_t kept = 2 * max_tilt_angles + numbers_before_angles;
        if (field.commas != field.text.size()) {
            ++with_decimals_;
            if (fields_.size() < kept) {
                fields_.push_back(field.text);
            }
        }
        for (std::size_t i = 0; i < field.text.size();) {
            const std::size_t end = std::min(field.text.find(',', i), field.text.size());
            if (end > i) {
                ++with_separators_;
                if (separated_.size() < kept) {
                    separated_.push_back(field.text.substr(i, end - i));
                }
            }
            i = end + 1;
        }
        if (field.is_decimal()) {
            surely_decimal_ = surely_decimal_ || !field.could_be_thousands();
            if (first_decimal_.empty()) {
                first_decimal_ = field.text;
                decimal_line_ = line;
            }
        }
    }

    static std::optional<std::size_t> integer(const std::vector<std::string_view>& numbers,
                                              std::size_t index) {
        if (index >= numbers.size()) {
            return std::nullopt;
        }
        const std::string_view text = numbers[index];
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const std::string_view tail(end, static_cast<std::size_t>(text.data() + text.size() - end));
        const bool whole = tail.find_first_not_of(",.0") == std::string_view::npos;
        return error == std::errc() && whole ? std::optional(value) : std::nullopt;
    }

    std::vector<std::string_view> fields_, separated_;  // the first ones
    std::size_t with_decimals_ = 0, with_separators_ = 0;
    std::string_view first_decimal_;
    int decimal_line_ = 0;  // from where the text begins
    bool surely_decimal_ = false;
};

}  // namespace

bool resolve_commas(IesReader& reader, bool tilt_included) {
    const Census census(reader.rest());
    if (!census.any_decimal()) {
        return false;
    }
    const auto separated = census.expected(true, tilt_included);
    if (separated && census.with_separators() <= *separated) {
        return false;  // fits, or too few: then the reader says what is missing
    }
    if (census.expected(false, tilt_included) == census.with_decimals() &&
        census.surely_decimal()) {
        reader.read_decimal_commas();
        return true;
    }
    reader.fail(reader.line() + census.decimal_line(),
                fmt::format("decimal comma in \"{}\": numbers have decimal points",
                            census.first_decimal().substr(0, 40)));
}

}  // namespace raybundle
